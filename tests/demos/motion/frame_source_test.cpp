#include "demos/motion/frame_source.h"

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_file.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

/// Frames at steps (60 fps of 240 steps/s) and between them.
class FrameSourceAt : public testing::TestWithParam<double> {};

TEST_P(FrameSourceAt, ARecordingGivesTheSimulatedStates) {
  const TemporaryFolder folder;
  const Scene scene = readSceneFile(findScene("bouncing-ball"));
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const FrameClock clock({GetParam(), scene.rate_hz});
  const int frames = static_cast<int>(GetParam());
  RunFacts facts;
  FrameSource simulated(made, clock, facts);
  RecordingHeader header;
  header.rate_hz = scene.rate_hz;
  header.fps = GetParam();
  header.duration_s = 1.0;
  header.bodies = static_cast<int>(made.names.size());
  header.frames = frames;
  RecordingWriter writer(folder.path() / "run.carom", header);
  std::vector<std::vector<BodyState>> states;
  std::vector<std::uint64_t> hashes;
  for (int frame = 0; frame < frames; ++frame) {
    const FrameState state = simulated.at(frame);
    writer.add(state);
    states.emplace_back(state.bodies.begin(), state.bodies.end());
    hashes.push_back(state.state_hash);
  }
  writer.commit();
  EXPECT_LT(facts.smallest_gap_m, 10.0) << "steps were looked at";
  RecordingReader reader(folder.path() / "run.carom");
  FrameSource recorded(reader);
  for (int frame = 0; frame < frames; ++frame) {
    const FrameState state = recorded.at(frame);
    EXPECT_EQ(state.state_hash, hashes[static_cast<std::size_t>(frame)]) << frame;
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
      const BodyState& expected = states[static_cast<std::size_t>(frame)][i];
      EXPECT_EQ(state.bodies[i].X_WB.position, expected.X_WB.position) << frame;
      EXPECT_EQ(state.bodies[i].X_WB.rotation.coeffs(), expected.X_WB.rotation.coeffs()) << frame;
      EXPECT_EQ(state.bodies[i].linear_velocity, expected.linear_velocity) << frame;
      EXPECT_EQ(state.bodies[i].angular_velocity, expected.angular_velocity) << frame;
      EXPECT_EQ(state.bodies[i].mode, expected.mode) << frame;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, FrameSourceAt, testing::Values(60.0, 50.0, 7.0, 97.0));

}  // namespace
}  // namespace carom::demos
