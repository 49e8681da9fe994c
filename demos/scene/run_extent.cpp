#include "demos/scene/run_extent.h"

#include <algorithm>
#include <cmath>

#include "demos/scene/scene_world.h"
#include "demos/system/interrupt.h"
#include "renderer/view/solid_extent.h"

namespace carom::demos {
namespace {

constexpr int kMostMoments = 96;
constexpr int kFewestMoments = 8;
constexpr int kMostBoxes = 100000;  // of all moments: 19 MB of corners

}  // namespace

std::vector<Vec3> pointsOfTheRun(const Scene& scene, const std::optional<std::filesystem::path>& mesh,
                                 int threads) {
  SceneWorld made = makeSceneWorld(scene, mesh, threads);
  const World& world = made.world;
  std::vector<std::size_t> moving;
  std::vector<renderer::Extent> extents;
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    if (world.bodies()[i].is_static) continue;
    moving.push_back(i);
    extents.push_back(renderer::solidExtent(made.drawn(i)));
  }
  const int steps = static_cast<int>(std::lround(scene.written_duration_s * scene.rate_hz));
  const int affordable = kMostBoxes / std::max(1, static_cast<int>(moving.size()));
  const int moments = std::clamp(std::min(affordable, steps), kFewestMoments, kMostMoments);
  std::vector<Vec3> points;
  int next = 0;  // moment
  for (int step = 0; step <= steps; ++step) {
    // Moment k is at step round(k steps / moments), in whole numbers.
    if (static_cast<long long>(step) * moments >= static_cast<long long>(next) * steps) {
      for (std::size_t i = 0; i < moving.size(); ++i)
        renderer::addCorners(extents[i], world.states()[moving[i]].X_WB, points);
      ++next;
    }
    if (step == steps) break;
    throwIfInterrupted();
    made.world.step();
  }
  return points;
}

}  // namespace carom::demos
