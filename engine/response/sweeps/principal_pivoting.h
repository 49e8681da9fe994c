#pragma once
// A few frictionless rows at once, where sweeps between bodies of very different mass would take thousands:
// impulses >= 0 that press only where the rows do not part faster than is wanted, a linear complementarity
// problem, solved by principal pivoting (Murty 1974). Tested in
// tests/engine/response/sweeps/principal_pivoting_test.cpp.

#include <Eigen/Core>
#include <optional>
#include <span>

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// Of more rows than these it is cheaper to sweep, where that converges: every pivot eliminates them anew.
inline constexpr std::size_t kMostPivotedRows = 32;

/// Impulses of rows whose speeds they change by `response` times them (symmetric, positive semidefinite), so
/// that what was `missing` of each row's speed is made up for up to `slack`. None where rows contradict each
/// other, or no such are found in four pivots a row. Rows that repeat each other share what they press.
std::optional<Eigen::VectorXd> pivotImpulses(const Eigen::MatrixXd& response, const Eigen::VectorXd& missing,
                                             const Eigen::VectorXd& slack);

/// Gives bodies the normal impulses by which all rows, which have had none, part at their lowest speeds less
/// their `slack_mps`. False, and nothing changes, where `pivotImpulses` finds none, or for more than
/// `most_rows`.
bool pivotRows(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, const Eigen::VectorXd& slack_mps,
               std::size_t most_rows = kMostPivotedRows);

}  // namespace carom
