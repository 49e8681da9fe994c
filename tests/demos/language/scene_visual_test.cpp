// "visual": what is drawn in place of a body, and changes nothing else.
#include <gtest/gtest.h>

#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"
#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

constexpr const char* kLeaf = "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n";

std::string sceneText(const std::string& visual) {
  return R"({ "format": 1, "bodies": [ { "name": "a", "shape": { "box": [1, 1, 1] }, "position": [0, 0, 3])" +
         visual +
         R"( }, { "name": "b", "shape": { "sphere": { "radius": 0.5 } }, "position": [3, 0, 3] } ] })";
}

SceneWorld worldOf(const TemporaryFolder& folder, const std::string& visual) {
  return makeSceneWorld(parseScene(sceneText(visual), folder.path() / "scene.json"), std::nullopt);
}

TEST(Visual, IsDrawnInPlaceOfTheShape) {
  const TemporaryFolder folder;
  folder.file("leaf.obj", kLeaf);
  const SceneWorld made =
      worldOf(folder, R"(, "visual": { "file": "leaf.obj", "scale": 0.5, "position": [0, 0, 0.25] })");
  const std::vector<renderer::Instance> drawn = drawnInstances(made, made.world.states());
  ASSERT_EQ(drawn.size(), 2u);
  ASSERT_EQ(made.drawnSolids().size(), 3u);
  EXPECT_EQ(drawn[0].solid, 2);
  EXPECT_EQ(drawn[1].solid, 1) << "as it is simulated";
  const BoundingSurface& look = made.drawnSolids()[2].surface();
  ASSERT_EQ(look.mesh.triangles.size(), 2u);
  EXPECT_NEAR((look.mesh.vertices[1] - Vec3(1.0, 0.0, 0.25)).norm(), 0.0, 1e-6);
  EXPECT_DOUBLE_EQ(made.drawnSolids()[2].volume(), 1.0) << "the body's own";
  EXPECT_TRUE(made.looksOtherwise(0));
  EXPECT_FALSE(made.looksOtherwise(1));
  EXPECT_NEAR(made.drawnRadius(0), std::hypot(1.0, 0.25), 1e-6);
  EXPECT_EQ(made.drawnRadius(1), 0.5);
}

// The surface's grain suits what is seen: a leaf of 2 cm in place of a cube of 1 m.
TEST(Visual, HasASurfaceOfItsOwnScale) {
  const TemporaryFolder folder;
  folder.file("leaf.obj", kLeaf);
  const SceneWorld made = worldOf(
      folder, R"(, "material": { "surface": "wood" }, "visual": { "file": "leaf.obj", "scale": 0.01 })");
  EXPECT_EQ(made.surfaces[0].scale_m, renderer::usualScale(0.02));
}

TEST(Visual, ChangesNoBitOfTheMotion) {
  const TemporaryFolder folder;
  folder.file("leaf.obj", kLeaf);
  SceneWorld plain = worldOf(folder, ""),
             other = worldOf(folder, R"(, "visual": { "file": "leaf.obj", "fit": 1 })");
  for (int step = 0; step < 240; ++step) {
    plain.world.step();
    other.world.step();
  }
  EXPECT_EQ(plain.world.stateHash(), other.world.stateHash());
}

TEST(Visual, ThatIsWrongIsRefusedInOneLine) {
  const TemporaryFolder folder;
  folder.file("leaf.obj", kLeaf);
  folder.file("none.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n");
  const auto message = [&folder](const std::string& visual) {
    return thrownMessage<InputError>([&] { worldOf(folder, R"(, "visual": )" + visual); });
  };
  EXPECT_NE(message(R"({ "file": "leef.obj" })").find("no file \"leef.obj\""), std::string::npos);
  EXPECT_NE(message(R"({ "scale": 2 })").find("file"), std::string::npos);
  EXPECT_NE(message(R"({ "file": "leaf.obj", "hull": true })").find("hull"), std::string::npos);
  EXPECT_NE(message(R"({ "file": "leaf.obj", "up": "x" })").find("accepted: \"y\", \"z\""),
            std::string::npos);
  EXPECT_NE(message(R"({ "file": "leaf.obj", "scale": 1e9 })").find("longest side"), std::string::npos);
  EXPECT_NE(message(R"({ "file": "none.obj" })").find("none.obj"), std::string::npos);
}

}  // namespace
}  // namespace carom::demos
