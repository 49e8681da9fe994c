#include "demos/recording.h"

#include <bit>
#include <limits>

#include <gtest/gtest.h>

#include "demos/asset_path.h"
#include "engine/foundation/contract.h"
#include "temporary_folder.h"
#include "thrown_message.h"

namespace carom::demos {
namespace {

constexpr int kBodies = 3;
constexpr int kFrames = 4;

/// Body 0 rests, body 1 moves, body 2 stops after frame 1; numbers whose bits are easily lost.
std::vector<BodyState> statesAt(int frame) {
  std::vector<BodyState> states(kBodies);
  states[0].mode = Mode::kResting;
  states[0].X_WB.position = Vec3(-0.0, 0.1, 5e-324);
  states[1].mode = Mode::kColliding;
  states[1].X_WB.position = Vec3(0.1 * frame, std::numeric_limits<double>::max(), -1.0 / 3.0);
  states[1].X_WB.rotation = Quat(0.5, 0.1 * frame, -0.0, -0.3);
  states[1].linear_velocity = Vec3(0.0, -0.0, 1.0 / 7.0);
  states[2].X_WB.position = Vec3(std::min(frame, 2), 0, 0);
  states[2].angular_velocity = Vec3(0.0, frame < 2 ? 1.0 : -0.0, 0.0);
  return states;
}

RecordingHeader someHeader() {
  RecordingHeader header;
  header.scene = "ball \"quoted\"";
  header.mesh = "/a/b.stl";
  header.scene_hash = 0xfedcba9876543210ull;
  header.seed = std::numeric_limits<std::uint64_t>::max();
  header.rate_hz = 1000.0 / 3.0;
  header.fps = 29.97;
  header.duration_s = 0.1;
  header.bodies = kBodies;
  header.frames = kFrames;
  return header;
}

std::filesystem::path someRecording(const TemporaryFolder& folder) {
  RecordingWriter writer(folder.path() / "run.carom", someHeader());
  for (int k = 0; k < kFrames; ++k) {
    const std::vector<BodyState> states = statesAt(k);
    writer.add({states, 10 * k, 0x1111ull * static_cast<unsigned>(k)});
  }
  writer.commit();
  return folder.path() / "run.carom";
}

std::string bits(const BodyState& s) {
  std::string text = std::to_string(static_cast<int>(s.mode));
  const auto add = [&](double x) {
    text.append(" ").append(std::to_string(std::bit_cast<std::uint64_t>(x)));
  };
  for (const Vec3& v : {s.X_WB.position, Vec3(s.X_WB.rotation.vec()), s.linear_velocity, s.angular_velocity})
    for (const double x : v) add(x);
  add(s.X_WB.rotation.w());
  return text;
}

void expectFrame(RecordingReader& reader, int frame) {
  const FrameState state = reader.advanceTo(frame);
  EXPECT_EQ(state.step, 10 * frame);
  EXPECT_EQ(state.state_hash, 0x1111ull * static_cast<unsigned>(frame));
  ASSERT_EQ(state.bodies.size(), static_cast<std::size_t>(kBodies));
  for (std::size_t i = 0; i < kBodies; ++i)
    EXPECT_EQ(bits(state.bodies[i]), bits(statesAt(frame)[i])) << frame << ' ' << i;
}

TEST(Recording, GivesBackEveryBit) {
  const TemporaryFolder folder;
  RecordingReader reader(someRecording(folder));
  EXPECT_EQ(reader.header().scene, someHeader().scene);
  EXPECT_EQ(reader.header().mesh, someHeader().mesh);
  EXPECT_EQ(reader.header().scene_hash, someHeader().scene_hash);
  EXPECT_EQ(reader.header().seed, someHeader().seed);
  EXPECT_EQ(reader.header().rate_hz, someHeader().rate_hz);
  EXPECT_EQ(reader.header().fps, someHeader().fps);
  EXPECT_EQ(reader.header().duration_s, someHeader().duration_s);
  for (int k = 0; k < kFrames; ++k) expectFrame(reader, k);
}

TEST(Recording, SkippedFramesAndAskingTwiceChangeNothing) {
  const TemporaryFolder folder;
  RecordingReader reader(someRecording(folder));
  expectFrame(reader, 2);
  expectFrame(reader, 2);
  expectFrame(reader, 3);
}

TEST(Recording, ABodyAtRestCostsOneByteAFrame) {
  const TemporaryFolder folder;
  const auto sizeWith = [&](int frames) {
    RecordingHeader header = someHeader();
    header.frames = frames;
    header.bodies = 1;
    RecordingWriter writer(folder.path() / "rest.carom", header);
    const std::vector<BodyState> states = statesAt(0);
    for (int k = 0; k < frames; ++k) writer.add({std::span(states).first(1), 0, 0});
    writer.commit();
    return std::filesystem::file_size(folder.path() / "rest.carom");
  };
  constexpr std::uintmax_t kBlockAndFrameHead = 1 + 4 + 8 + 16;
  EXPECT_EQ(sizeWith(9) - sizeWith(8), kBlockAndFrameHead + 1);
}

TEST(Recording, EveryTruncationIsNoticedBeforeAnythingIsDrawn) {
  const TemporaryFolder folder;
  const std::string whole = readTextFile(someRecording(folder));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto file = folder.file("cut.carom", whole.substr(0, size));
    const std::string message = thrownMessage<InputError>([&] { RecordingReader reader(file); });
    EXPECT_EQ(message.rfind(file.string() + ": ", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST(Recording, EveryFlippedBitIsNoticed) {
  const TemporaryFolder folder;
  const std::string whole = readTextFile(someRecording(folder));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
    const auto file = folder.file("damaged.carom", damaged);
    EXPECT_THROW(RecordingReader reader(file), InputError) << at;
  }
  EXPECT_THROW(RecordingReader reader(folder.file("long.carom", whole + "x")), InputError);
}

TEST(Recording, ForeignFilesAndOtherVersionsAreNamedAsSuch) {
  const TemporaryFolder folder;
  const auto messageOf = [&](const std::string& text) {
    const auto file = folder.file("other", text);
    return thrownMessage<InputError>([&] { RecordingReader reader(file); });
  };
  EXPECT_NE(messageOf("{ \"format\": 1 }").find("no recording"), std::string::npos);
  EXPECT_NE(messageOf("").find("no recording"), std::string::npos);
  std::string later = readTextFile(someRecording(folder));
  later[8] = 2;
  EXPECT_NE(messageOf(later).find("version 2: accepted: version 1"), std::string::npos);
  EXPECT_THROW(RecordingReader reader(folder.path()), InputError);
  EXPECT_THROW(RecordingReader reader(folder.path() / "none.carom"), InputError);
}

TEST(Recording, OneThatIsGivenUpLeavesNothing) {
  const TemporaryFolder folder;
  {
    RecordingWriter writer(folder.path() / "run.carom", someHeader());
    const std::vector<BodyState> states = statesAt(0);
    writer.add({states, 0, 0});
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace carom::demos
