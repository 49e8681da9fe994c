#include "demos/scene/scene_world.h"

#include <gtest/gtest.h>

#include "demos/language/scene_file.h"
#include "engine/foundation/contract.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

SceneWorld worldOf(const std::string& bodies, std::uint64_t seed = 1) {
  Scene scene = parseScene("{ \"format\": 1, \"bodies\": [" + bodies + "] }", "s.json");
  scene.seed = seed;
  return makeSceneWorld(scene, std::nullopt);
}

const std::string kRepeated =
    "{ \"name\": \"crate\", \"shape\": { \"box\": [1, 1, 1] }, \"position\": [10, 0, 0], \"color\": "
    "[\"#ff0000\", \"#00ff00\"],"
    " \"repeat\": { \"count\": [2, 3, 4], \"step\": [2, 3, 4], \"jitter\": 0.05, \"jitterDegrees\": 20 } }";

TEST(SceneWorld, LaysCopiesOutOnTheLattice) {
  const SceneWorld made = worldOf(kRepeated);
  ASSERT_EQ(made.names.size(), 24u);
  EXPECT_EQ(made.world.solids().size(), 1u);
  EXPECT_EQ(made.names[23], "crate[23]");
  EXPECT_EQ(made.looks[22].color.r, 1.0f);
  EXPECT_EQ(made.looks[23].color.g, 1.0f);
  double farthest = 0.0;
  for (int k = 0; k < 24; ++k) {
    const Vec3 lattice(10.0 + 2.0 * (k % 2), 3.0 * (k / 2 % 3), 4.0 * (k / 6));
    const Vec3 shift = made.world.states()[static_cast<std::size_t>(k)].X_WB.position - lattice;
    farthest = std::max(farthest, shift.cwiseAbs().maxCoeff());
  }
  // 72 uniform numbers in [-0.05, 0.05): the largest is above 0.04 but for a chance of 0.8^72 = 1e-7.
  EXPECT_LE(farthest, 0.05);
  EXPECT_GT(farthest, 0.04);
}

TEST(SceneWorld, JitterFollowsTheSeedAndNothingElse) {
  EXPECT_EQ(worldOf(kRepeated, 5).world.stateHash(), worldOf(kRepeated, 5).world.stateHash());
  EXPECT_NE(worldOf(kRepeated, 5).world.stateHash(), worldOf(kRepeated, 6).world.stateHash());
}

TEST(SceneWorld, PositionIsThatOfTheDescribedFrame) {
  // A tetrahedron whose centre of mass is (1/4, 1/4, 1/4) off its own origin, turned by 180 degrees about z.
  const SceneWorld made = worldOf(
      "{ \"name\": \"t\", \"shape\": { \"hull\": { \"points\": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]] } }, "
      "\"position\": [5, 6, 7],"
      " \"rotation\": [0, 0, 0, 1] }");
  EXPECT_LT((made.world.states()[0].X_WB.position - Vec3(4.75, 5.75, 7.25)).norm(), 1e-12);
}

TEST(SceneWorld, RefusesAnOverlapWithBothNamesTheDepthAndThePlace) {
  const std::string message = thrownMessage<InputError>([] {
    worldOf(
        "{ \"name\": \"floor\", \"shape\": { \"box\": [4, 4, 1] }, \"position\": [0, 0, -0.5], \"static\": "
        "true },"
        "{ \"name\": \"ball\", \"shape\": { \"sphere\": { \"radius\": 0.5 } }, \"position\": [1, -1, 0.25] "
        "}");
  });
  EXPECT_EQ(message,
            "s.json: \"floor\" and \"ball\" overlap at the start by 0.25 m at (1, -1, -0.125); accepted: "
            "apart, or just touching");
}

TEST(SceneWorld, RefusesBodiesThatTouchAndHaveNoRoomToPart) {
  const std::string message = thrownMessage<InputError>([] {
    worldOf(
        "{ \"name\": \"floor\", \"shape\": { \"box\": [4, 4, 1] }, \"position\": [0, 0, -0.5], \"static\": "
        "true },"
        "{ \"name\": \"ceiling\", \"shape\": { \"box\": [4, 4, 1] }, \"position\": [0, 0, 1.5], \"static\": "
        "true },"
        "{ \"name\": \"ball\", \"shape\": { \"sphere\": { \"radius\": 0.5 } }, \"position\": [1, -1, 0.5] }");
  });
  EXPECT_EQ(message,
            "s.json: \"floor\" and \"ball\" touch at the start and have no room to part at (1, -1, 0) (the "
            "deepest of 2 pairs; carom check lists them all); accepted: apart");
}

TEST(SceneWorld, RefusesASliderThatTouchesItsGuide) {
  const std::string message = thrownMessage<InputError>([] {
    worldOf(
        "{ \"name\": \"guide\", \"shape\": { \"box\": [4, 4, 1] }, \"position\": [0, 0, -0.5], \"static\": "
        "true },"
        "{ \"name\": \"slider\", \"shape\": { \"sphere\": { \"radius\": 0.5 } }, \"position\": [1, -1, 0.5], "
        "\"locked\": [\"y\", \"z\"] }");
  });
  EXPECT_EQ(message,
            "s.json: \"guide\" and \"slider\" touch at the start and have no room to part along free axes at "
            "(1, -1, 0); accepted: apart, or an axis not locked that parts them");
}

TEST(SceneWorld, AcceptsBodiesThatJustTouch) {
  const SceneWorld made = worldOf(
      "{ \"name\": \"floor\", \"shape\": { \"box\": [4, 4, 1] }, \"position\": [0, 0, -0.5], \"static\": "
      "true },"
      "{ \"name\": \"crate\", \"shape\": { \"box\": [1, 1, 1] }, \"position\": [0, 0, 0.5] }");
  EXPECT_EQ(made.world.bodies().size(), 2u);
}

// 200 million pairs: 3.4 GB before one was looked at.
TEST(SceneWorld, TwentyThousandBodiesInOnePlaceAreRefusedInOneLine) {
  const std::string message = thrownMessage<InputError>([] {
    worldOf(
        "{ \"name\": \"b\", \"shape\": { \"sphere\": { \"radius\": 0.5 } }, "
        "\"repeat\": { \"count\": [20000, 1, 1], \"step\": [0, 0, 0] } }");
  });
  EXPECT_EQ(
      message,
      "s.json: more than 1000000 pairs of bodies overlap or come near each other within a step; accepted: "
      "fewer, slower or farther apart bodies, or more steps a second");
}

TEST(SceneWorld, BodiesThatFlyThroughAllOthersInAStepAreRefusedLikewise) {
  const std::string message = thrownMessage<InputError>([] {
    Scene scene = parseScene(
        "{ \"format\": 1, \"rate\": 10, \"bodies\": [ { \"name\": \"b\", \"shape\": { \"box\": [1, 1, 1] }, "
        "\"linearVelocity\": [1e5, 0, 0], \"repeat\": { \"count\": [20000, 1, 1], \"step\": [2, 0, 0] } } ] "
        "}",
        "s.json");
    makeSceneWorld(scene, std::nullopt);
  });
  EXPECT_NE(message.find("more steps a second"), std::string::npos) << message;
}

TEST(SceneWorld, MorePartsThanCanBeKeptAreRefused) {
  std::string parts;
  for (int i = 0; i < 20; ++i)
    parts += std::string(i > 0 ? "," : "") +
             "{ \"shape\": { \"sphere\": { \"radius\": 0.1 } }, \"position\": [0, 0, " + std::to_string(i) +
             "] }";
  const std::string message = thrownMessage<InputError>([&parts] {
    worldOf("{ \"name\": \"b\", \"shape\": { \"compound\": [" + parts +
            "] }, \"repeat\": { \"count\": [10001, 1, 1], \"step\": [1, 0, 0] } }");
  });
  EXPECT_EQ(message, "s.json: the bodies have 200020 convex parts; accepted: at most 200000");
}

TEST(SceneWorld, AHullHasTheLengthsOfAnyOtherShape) {
  const auto messageOf = [](const std::string& hull) {
    return thrownMessage<InputError>([&hull] {
      worldOf("{ \"name\": \"t\", \"shape\": { \"hull\": { \"points\": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], " +
              hull + " } } }");
    });
  };
  EXPECT_NE(
      messageOf("\"scale\": 1e9").find("the hull's longest side is 1e+09 m; accepted: 0.0001 to 100000"),
      std::string::npos);
  EXPECT_NE(messageOf("\"scale\": 1e-9").find("the hull's longest side is 1e-09 m"), std::string::npos);
  EXPECT_NE(thrownMessage<InputError>([] {
              worldOf(
                  "{ \"name\": \"t\", \"shape\": { \"hull\": { \"points\": "
                  "[[9,0,0],[10,0,0],[9,1,0],[9,0,1]], \"scale\": 20000 } } }");
            }).find("the hull reaches to 200000 m; accepted: -100000 to 100000"),
            std::string::npos);
}

TEST(SceneWorld, TakesAMeshOnlyWhereOneCanBeReplaced) {
  const Scene scene = parseScene(
      "{ \"format\": 1, \"bodies\": [ { \"name\": \"a\", \"shape\": { \"box\": [1, 1, 1] } } ] }", "s.json");
  EXPECT_EQ(thrownMessage<InputError>([&] { makeSceneWorld(scene, "x.obj"); }),
            "s.json: takes no --mesh: no mesh in it says \"replaceable\": true");
}

}  // namespace
}  // namespace carom::demos
