#pragma once
// Shapes, materials and bodies of the explorer's worlds. Tested through tests/explore/random_world_test.cpp.

#include <span>

#include "demos/scene/scene.h"
#include "tests/oracle/test_shapes.h"

namespace carom::explore {

inline constexpr double kSmallestShape_m = 1e-4;  ///< What a scene may hold.
inline constexpr double kLargestSpeed = 1e4;

bool oneIn(oracle::Random& random, int n);
/// The radius of the ball about the shape's own origin that holds it.
double reachOf(const demos::Shape& shape);
/// Where bodies are scattered over the plane z = 0: within a square as wide as it takes, and above it by
/// shares of that.
struct ScatteredOver {
  double wide_m = 1.0;  ///< Half of a side, at first.
  double lowest = 0.0;
  double highest = 1.0;
};
/// Of a body that reaches so far; its ball is clear of those of the others, and above the plane.
Pose scatteredPose(oracle::Random& random, double reach_m, std::span<const demos::Body> others,
                   const ScatteredOver& over);
demos::Shape boxOf(const Vec3& size);
/// Boxes, needles, plates, balls, capsules, hulls, compounds; `size`: the longest extent, about.
demos::Shape anyShape(oracle::Random& random, double size);
Material anyMaterial(oracle::Random& random);
/// Appends a body that is named after its place.
demos::Body& addBody(demos::Scene& scene, demos::Shape shape, const Pose& X_WS, const Material& material);
/// Locks some of its axes, or none.
void lockAtRandom(oracle::Random& random, demos::Body& body);
/// One of the shipped meshes as it is: rings, links, cups, gears, a nut, a bolt, ...; its longest side.
demos::Shape concaveOf(oracle::Random& random, double size);

}  // namespace carom::explore
