#pragma once
// A shipped scene, simulated by a test.

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"
#include "tests/support/world_energy.h"

namespace carom::demos {

struct Played {
  explicit Played(const std::string& name)
      : scene(readSceneFile(findScene(name))), made(makeSceneWorld(scene, std::nullopt)) {}

  const BodyState& state(const std::string& name) const {
    const auto found = std::find(made.names.begin(), made.names.end(), name);
    EXPECT_NE(found, made.names.end()) << name;
    return made.world.states()[static_cast<std::size_t>(found - made.names.begin())];
  }
  Vec3 place(const std::string& name) const { return state(name).X_WB.position; }
  void run(double until_s) {
    while (made.world.time() < until_s) made.world.step();
  }
  double energy() const { return energyOf(made.world); }

  Scene scene;
  SceneWorld made;
};

}  // namespace carom::demos
