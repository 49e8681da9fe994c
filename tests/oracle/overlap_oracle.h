#pragma once
// Oracle: the smallest gap over every pair of bodies, by brute force and separating axes; for checking a
// world frame by frame. Pairs whose bounding balls are farther apart than the smallest gap so far are passed
// over. Tested in tests/oracle/oracle_test.cpp.

#include <limits>
#include <span>
#include <vector>

#include "engine/simulation/world.h"
#include "tests/oracle/brute_force_distance.h"

namespace carom::oracle {

struct PlacedSolid {
  const Solid* solid = nullptr;
  Pose X_WB;
  bool is_static = false;
};

struct SmallestGap {
  double gap_m =
      std::numeric_limits<double>::infinity();  ///< Negative: minus the depth of the deepest overlap.
  int body_a = -1;
  int body_b = -1;
};

/// Over all pairs of bodies of which at least one can move.
inline SmallestGap smallestGap(std::span<const PlacedSolid> bodies) {
  std::vector<std::vector<PlacedConvex>> parts(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (const ConvexPart& part : bodies[i].solid->parts()) parts[i].push_back(place(part, bodies[i].X_WB));
  SmallestGap smallest;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      if (bodies[i].is_static && bodies[j].is_static) continue;
      const double apart = (bodies[i].X_WB.position - bodies[j].X_WB.position).norm();
      if (apart - bodies[i].solid->radius() - bodies[j].solid->radius() > smallest.gap_m) continue;
      for (const PlacedConvex& a : parts[i])
        for (const PlacedConvex& b : parts[j])
          if (const auto gap = static_cast<double>(signedGap(a, b)); gap < smallest.gap_m)
            smallest = {gap, static_cast<int>(i), static_cast<int>(j)};
    }
  return smallest;
}

/// The same for the bodies of a world as they stand.
inline SmallestGap smallestGap(const World& world) {
  std::vector<PlacedSolid> bodies;
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    const BodyDescription& body = world.bodies()[i];
    bodies.push_back(
        {&world.solids()[static_cast<std::size_t>(body.solid)], world.states()[i].X_WB, body.is_static});
  }
  return smallestGap(bodies);
}

}  // namespace carom::oracle
