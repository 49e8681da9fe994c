#include "demos/frame_source.h"

#include <gtest/gtest.h>

#include "demos/asset_path.h"
#include "demos/scene_file.h"
#include "temporary_folder.h"

namespace carom::demos {
namespace {

TEST(FrameSource, ARecordingGivesTheSimulatedStates) {
  const TemporaryFolder folder;
  const Scene scene = readSceneFile(findScene("bouncing-ball"));
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const FrameClock clock({50.0, scene.rate_hz});
  constexpr int kFrames = 12;
  RunFacts facts;
  FrameSource simulated(made, clock, facts);
  RecordingHeader header;
  header.bodies = static_cast<int>(made.names.size());
  header.frames = kFrames;
  RecordingWriter writer(folder.path() / "run.carom", header);
  std::vector<Vec3> positions;
  std::vector<std::uint64_t> hashes;
  for (int frame = 0; frame < kFrames; ++frame) {
    const FrameState state = simulated.at(frame);
    writer.add(state);
    positions.push_back(state.bodies[1].X_WB.position);
    hashes.push_back(state.state_hash);
  }
  writer.commit();
  EXPECT_LT(facts.smallest_gap_m, 10.0) << "steps were looked at";
  RecordingReader reader(folder.path() / "run.carom");
  FrameSource recorded(reader);
  for (int frame = 0; frame < kFrames; ++frame) {
    const FrameState state = recorded.at(frame);
    EXPECT_EQ(state.bodies[1].X_WB.position, positions[static_cast<std::size_t>(frame)]) << frame;
    EXPECT_EQ(state.state_hash, hashes[static_cast<std::size_t>(frame)]) << frame;
  }
}

}  // namespace
}  // namespace carom::demos
