#pragma once
// The contact solver for structures that stand (paper §2.4, §2.5): sweeps, and where they have not converged,
// steps that solve all held rows at once, with sweeps after each that bring the impulses back into their
// cones. A wall of 610 bricks comes to 1e-5 of a step's gravity within eight such steps from a cold start
// and, warm started, needs one now and then. In heaps of thousands of bodies the factor fills up: the
// products that steps may take can be bounded. Tested in tests/engine/response/standing_solver_test.cpp.

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// Like solveContactsFinely with these settings; where that ends above `residual_mps`, what a step at once
/// takes is reported, and such steps follow while all of them take no more than `most_products`. Never ends
/// farther from convergence than the sweeps alone.
SolverReport solveStandingContacts(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                                   const SolverSettings& settings);

}  // namespace carom
