#include "demos/record/recording.h"

#include <bit>
#include <limits>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/format/content_hash.h"
#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

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
  states[1].X_WB.rotation = Quat(0.5, 0.1 * frame, -0.0, -0.3).normalized();
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

/// A recording of a header and no frame, each block with the checksum it should have.
std::string emptyRecording(const std::string& header) {
  ContentHash sum;
  const auto block = [&sum](char kind, const std::string& payload) {
    const auto bytesOf = [](std::uint64_t value, std::size_t count) {
      return std::string(reinterpret_cast<const char*>(&value), count);
    };
    const std::string bytes = kind + bytesOf(payload.size(), 4) + payload;
    sum.add(bytes);
    return bytes + bytesOf(sum.value(), 8);
  };
  const std::string start = std::string("CAROMREC\1\0\0\0", 12) + block('H', header);
  return start + block('E', std::string(4, '\0'));
}

std::string headerOf(const std::string& bodies, const std::string& frames, const std::string& fps = "30") {
  return "{\"scene\": \"sliding\", \"mesh\": \"\", \"sceneHash\": \"0\", \"seed\": \"1\", "
         "\"stepsPerSecond\": 240, \"fps\": " +
         fps + ", \"duration_s\": 0.1, \"bodies\": " + bodies + ", \"frames\": " + frames + "}";
}

// By its word for the bodies a file of 208 bytes took 3 GB, or the program down.
TEST(Recording, CountsOfTheHeaderAreHeldAgainstTheFileBeforeAnythingIsKept) {
  const TemporaryFolder folder;
  const auto messageOf = [&](const std::string& header) {
    const auto file = folder.file("counts.carom", emptyRecording(header));
    return thrownMessage<InputError>([&] { RecordingReader reader(file); });
  };
  EXPECT_NO_THROW(RecordingReader reader(folder.file("none.carom", emptyRecording(headerOf("2", "0")))));
  for (const char* bodies : {"20001", "100000000", "1000000000", "-1", "1.5"})
    EXPECT_NE(messageOf(headerOf(bodies, "0")).find("accepted: a whole number from 0 to 20000"),
              std::string::npos);
  EXPECT_NE(messageOf(headerOf("20000", "1")).find("truncated"), std::string::npos);
  EXPECT_NE(messageOf(headerOf("0", "3600000")).find("truncated"), std::string::npos);
  EXPECT_NE(messageOf(headerOf("2", "0", "0")).find("fps: 0 is out of range; accepted: above 0 to 1000"),
            std::string::npos);
  EXPECT_NE(messageOf(std::string(70000, ' ') + headerOf("2", "0")).find("damaged"), std::string::npos);
}

TEST(Recording, AStateThatNoBodyCanBeInIsDamage) {
  const TemporaryFolder folder;
  for (const double w : {0.0, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
    RecordingHeader header = someHeader();
    header.bodies = header.frames = 1;
    RecordingWriter writer(folder.path() / "state.carom", header);
    std::vector<BodyState> states(1);
    states[0].X_WB.rotation = Quat(w, 0.0, 0.0, 0.0);
    writer.add({states, 0, 0});
    writer.commit();
    EXPECT_THROW(RecordingReader reader(folder.path() / "state.carom"), InputError) << w;
  }
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
