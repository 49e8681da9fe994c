#pragma once
// Newton's method on the conditions of contact rows (Alart and Curnier 1991): a row's impulse is the
// projection, into its cone, of itself less what its velocity misses, over its own response. So each row is
// idle, holds its point, or lets it slide, and the change of its impulse is linear in that of its velocity:
//   change = p - S J v,   v = W sum over the rows of J' (p - S J v),
// J the row's velocity per change v of the bodies' velocities, W the bodies' response. Tested in
// tests/engine/response/newton_solver_test.cpp.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// Rows that are solved for in several steps. Their resistance to turning does not act.
class NewtonRows {
 public:
  /// Rows must be prepared. Without friction, what there is of it is taken away.
  NewtonRows(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, bool friction);

  /// Changes impulses and velocities. A row that presses gives way to the change of its impulse by
  /// `compliance` (above zero) times its own response: rows may repeat each other, as the corners of a face
  /// do, and the larger it is, the less can a step overshoot (the proximal point method, Rockafellar 1976).
  /// Steps converge to rows without compliance. Impulses may leave their cones: sweeps must follow. False
  /// where the system has no solution; then nothing has changed.
  bool step(double compliance);

  /// The largest miss of a row's conditions, m/s.
  double miss() const;

 private:
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  /// (separating, t1, t2) per (linear, angular times the body's length) velocity.
  using RowJacobian = Eigen::Matrix<double, 3, 6>;

  /// A body that moves. Its length makes a speed of its turning, so that all unknowns are speeds.
  struct Moving {
    Mat6 response;
    double length_m = 1.0;
  };
  struct Place {
    int a = -1;  ///< In `moving_`; -1: it cannot move.
    int b = -1;
    RowJacobian of_a = RowJacobian::Zero();
    RowJacobian of_b = RowJacobian::Zero();
  };
  /// Of a row: impulse - stiffness times the change of its velocity.
  struct LinearLaw {
    Vec3 impulse = Vec3::Zero();
    Mat3 stiffness = Mat3::Zero();
  };
  void placeRows();
  LinearLaw lawOf(const ContactRow& row, double compliance) const;
  void add(const Place& place, const LinearLaw& law);

  std::span<ContactRow> rows_;
  std::span<ImpulseBody> bodies_;
  bool friction_;
  std::vector<Moving> moving_;
  std::vector<Place> places_;  ///< One a row.
  std::vector<LinearLaw> laws_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> system_;
  Eigen::VectorXd change_;
};

}  // namespace carom
