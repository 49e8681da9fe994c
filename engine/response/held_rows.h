#pragma once
// All contact rows that hold, solved at once. Sweeps carry a load from contact to contact, so that a wall of
// hundreds of bricks would need thousands of them; here its rows become one sparse linear system. One step of
// the augmented Lagrangian (Hestenes 1969; Powell 1969) with the rows that press as equations:
//   (M + J' S J) dv = -J' S (J v - b),   change of the impulses = -S (J (v + dv) - b),
// J the rows' velocities, b their bounds, S the inverse of each row's own response times kStiffness. A row
// that slides is an equation in its normal part; its friction is left to the sweeps, and so are the cones,
// resistance to turning, and rows whose gap may still close (a bound below zero): several of these at one
// face would contradict each other. Tested in tests/engine/response/standing_solver_test.cpp.

#include <optional>
#include <span>
#include <vector>

#include "engine/response/block_cholesky.h"
#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// The system of some rows, whose places and responses stay as they are from step to step.
class HeldRows {
 public:
  /// A miss of one row alone is left with a share of one in so many, one that a column of hundreds makes
  /// together with one in a thousand.
  static constexpr double kStiffness = 1e8;

  /// `bodies`: those that the rows refer to. Rows must be prepared.
  HeldRows(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies);

  /// Changes the impulses of the rows that press, and the velocities with them. Impulses may leave their
  /// cones: sweeps must follow. False when the system could not be solved; then nothing has changed.
  bool step(std::span<ContactRow> rows, std::span<ImpulseBody> bodies);
  /// What a step takes: products of 6 x 6 blocks.
  long products() const { return factor_->products(); }

 private:
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  using RowJacobian = Eigen::Matrix<double, 3, 6>;  ///< (separating, t1, t2) per (linear, angular) velocity.

  struct RowPlace {
    RowJacobian of_a;
    RowJacobian of_b;
    int slot_a = -1;  ///< Where the body stands in the system; -1: it cannot move.
    int slot_b = -1;
    int block = -1;  ///< Of the pair of bodies, in `blocks_`; -1: one of them cannot move.
  };
  void placeBodies(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies);
  void placeBlocks(std::span<const ContactRow> rows);
  void addRow(const RowPlace& place, const Mat3& stiffness, const Vec3& miss);

  std::vector<int> slots_;     ///< One a body; -1: it cannot move, or no row refers to it.
  std::vector<Mat6> inertia_;  ///< One a slot.
  std::vector<RowPlace> places_;
  std::vector<Mat6> diagonal_;            ///< One a slot.
  std::vector<OffDiagonalBlock> blocks_;  ///< By slots, column before row.
  Eigen::VectorXd push_;
  std::optional<BlockCholesky> factor_;  ///< Made once places are known.
};

}  // namespace carom
