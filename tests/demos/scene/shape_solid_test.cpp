#include "demos/scene/shape_solid.h"

#include <numbers>

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "engine/foundation/elementary.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

Shape shapeOf(decltype(Shape::form) form) {
  return {std::move(form), "s.json:7: bodies[2].shape.x"};
}

TEST(ShapeSolid, PrimitivesHaveTheirVolumes) {
  EXPECT_NEAR(makeSolid(shapeOf(BoxShape{Vec3(1.0, 2.0, 3.0)}), std::nullopt).volume(), 6.0, 1e-12);
  EXPECT_NEAR(makeSolid(shapeOf(SphereShape{0.5}), std::nullopt).volume(), std::numbers::pi / 6.0, 1e-12);
  EXPECT_NEAR(makeSolid(shapeOf(CapsuleShape{0.5, 2.0}), std::nullopt).volume(),
              std::numbers::pi / 6.0 + std::numbers::pi / 2.0, 1e-12);
}

TEST(ShapeSolid, CompoundPlacesItsParts) {
  CompoundShape compound;
  compound.parts.push_back(
      {shapeOf(BoxShape{Vec3(1.0, 1.0, 1.0)}), Pose{Quat::Identity(), Vec3(0.0, 0.0, 1.0)}});
  compound.parts.push_back({shapeOf(BoxShape{Vec3(3.0, 1.0, 1.0)}),
                            Pose{rotationBy(Vec3(0.0, 0.0, std::numbers::pi / 2.0)), Vec3(0.0, 4.0, 1.0)}});
  const Solid solid = makeSolid(shapeOf(std::move(compound)), std::nullopt);
  EXPECT_NEAR(solid.volume(), 4.0, 1e-12);
  // Centre of mass: (1 * (0, 0, 1) + 3 * (0, 4, 1)) / 4 = (0, 3, 1).
  EXPECT_LT((solid.origin_B() + Vec3(0.0, 3.0, 1.0)).norm(), 1e-12);
  double farthest_x = 0.0;
  for (const Vec3& p : solid.parts()[1].core.vertices()) farthest_x = std::max(farthest_x, p.x());
  EXPECT_NEAR(farthest_x, 0.5, 1e-12);  // the long side was turned from x to y
}

TEST(ShapeSolid, SaysWhereAFlatHullIsDescribed) {
  HullShape flat;
  flat.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)};
  const std::string message = thrownMessage<InputError>([&] { makeSolid(shapeOf(flat), std::nullopt); });
  EXPECT_EQ(message.rfind("s.json:7: bodies[2].shape.x: ", 0), 0u) << message;
  EXPECT_NE(message.find("flat"), std::string::npos) << message;
}

TEST(ShapeSolid, ReplacesOnlyReplaceableHulls) {
  const std::filesystem::path meshes = std::filesystem::path(CAROM_SOURCE_DIR) / "assets/meshes";
  HullShape hull;
  hull.file = meshes / "wedge.stl";
  EXPECT_NEAR(makeSolid(shapeOf(hull), meshes / "pyramid.stl").volume(), 0.15, 1e-6);
  hull.replaceable = true;
  EXPECT_NEAR(makeSolid(shapeOf(hull), meshes / "pyramid.stl").volume(), 0.8 / 3.0, 1e-6);
}

}  // namespace
}  // namespace carom::demos
