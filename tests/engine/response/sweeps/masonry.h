#pragma once
// Columns and walls of boxes as the contact solvers see them, for the tests of this folder.

#include <gtest/gtest.h>

#include <vector>

#include "engine/foundation/index.h"
#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {

inline constexpr double kGained = 9.81 / 60;  // m/s: what gravity gives in a step

/// Boxes of 1 x 0.5 x 0.25 m on a floor (body 0), which have just got a step's gravity.
struct Masonry {
  std::vector<ImpulseBody> bodies{immovable()};
  std::vector<ContactRow> rows;

  int lay(const Vec3& center, double mass_kg) {
    bodies.push_back(impulseBody(boxInertia(mass_kg, {1.0, 0.5, 0.25}), Quat::Identity(), center,
                                 {Vec3(0, 0, -kGained), Vec3::Zero()}));
    return static_cast<int>(bodies.size()) - 1;
  }
  /// The four corners of where `upper` lies on `lower`, between x = low and high.
  void bed(int lower, int upper, double low, double high, double friction) {
    const double z = bodies[at(upper)].center.z() - 0.125;
    for (double x : {low, high})
      for (double y : {-0.25, 0.25})
        rows.push_back(
            rowAt({.a = lower, .b = upper, .p_W = Vec3(x, y, z), .friction = {friction, friction}}, bodies));
  }
  double fastest() const {
    double speed = 0.0;
    for (const ImpulseBody& body : bodies)
      speed = std::max(speed, body.velocity.linear.norm() + body.velocity.angular.norm());
    return speed;
  }
};

/// Columns side by side; their topmost boxes have another mass.
inline Masonry columns(int count, int boxes, double top_kg = 1.0) {
  Masonry m;
  for (int c = 0; c < count; ++c) {
    const double x = 2.0 * c;
    for (int i = 0; i < boxes; ++i) {
      const int box = m.lay(Vec3(x, 0, 0.125 + 0.25 * i), i + 1 == boxes ? top_kg : 1.0);
      m.bed(i == 0 ? 0 : box - 1, box, x - 0.5, x + 0.5, 0.5);
    }
  }
  return m;
}

/// A running bond: every box on halves of two, or at the ends of odd courses of one.
inline Masonry wall(int courses, int length) {
  Masonry m;
  std::vector<int> below;
  for (int c = 0; c < courses; ++c) {
    std::vector<int> course;
    const int boxes = length - c % 2;
    for (int k = 0; k < boxes; ++k) {
      const double x = k - 0.5 * (boxes - 1);
      course.push_back(m.lay(Vec3(x, 0, 0.125 + 0.25 * c), 1.0));
      if (c == 0) m.bed(0, course.back(), x - 0.5, x + 0.5, 0.5);
      for (const int lower : below) {
        const double under = m.bodies[at(lower)].center.x();
        if (std::abs(under - x) < 0.9)
          m.bed(lower, course.back(), std::max(x, under) - 0.5, std::min(x, under) + 0.5, 0.5);
      }
    }
    below = course;
  }
  return m;
}

inline void expectWithinCones(const Masonry& m) {
  for (const ContactRow& row : m.rows) {
    EXPECT_GE(row.impulse.x(), 0.0);
    EXPECT_LE(row.impulse.tail<2>().norm(), row.coefficient * row.impulse.x() * (1 + 1e-9) + 1e-15);
  }
}

}  // namespace carom
