#pragma once
// The contact solver for few rows: some sweeps, then steps of Newton's method (newton_rows.h), where sweeps
// alone would creep for hundreds of rounds: points a millimetre apart, faces that stick, bodies a thousand
// times as heavy. Tested in tests/engine/response/newton_solver_test.cpp.

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// Of more rows than these a step costs more than the sweeps that it saves.
inline constexpr std::size_t kMostNewtonRows = 32;

/// As solveContacts, which it is for more rows than `kMostNewtonRows`; rows whose turning is resisted are
/// solved as if it were not. What two rounds of steps do not converge to is left as sweeps have it.
SolverReport solveContactsByNewton(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                                   const SolverSettings& settings);

}  // namespace carom
