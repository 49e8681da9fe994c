#pragma once
// The contact solver for crowds (paper §2.4): most of a heap is nearly solved by its warm start, and what is
// not lies around a few bodies. After some sweeps over all rows, those around the bodies that the sweeps
// stirred most are swept more, and of these again those around the most stirred, before all have their turn
// again. In heaps of thousands where some bodies still move, the row visits of 20 to 30 sweeps reach so what
// 60 sweeps over all rows reach; where all lie still it takes as many either way. Tested in
// tests/engine/response/focused_solver_test.cpp.

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// From so many rows on, the focused solver does not sweep all alike.
inline constexpr std::size_t kFocusedRows = 1000;

/// Like solveContactsFinely, which it is for fewer than `kFocusedRows` rows. Sweeps, asked for and reported,
/// are so many row visits as sweeps over all rows would make; the last round may go beyond. All sweeps over a
/// crowd are careful.
SolverReport solveContactsFocused(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                                  const SolverSettings& settings);

}  // namespace carom
