#include "demos/cause/motion_record.h"

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

RoundedPose poseAt(long long x) {
  return {x, -2 * x, 7, 10000, 0, x % 5, 0};
}

/// Two bodies, `moments` moments, one shot of 4x2 pixels.
MotionRecord sampleRecord(int moments) {
  MotionRecord r;
  r.scene = "sample";
  r.world = {{"gravity", "0 0 -9.81"}};
  r.look = {{"preset", "realtime"}};
  r.sources = {{"engine/solid/solid.cpp", "01234567"}};
  r.step_s = 1.0 / 240.0;
  r.length_quantum_m = 0x1p-14;
  for (const char* name : {"floor", "ball \"a\"\n"})
    r.bodies.push_back(
        {name, {{"position", "0 0 1"}}, {{"density", "800"}}, {{"volume", "1"}}, {{"color", "#fff000"}}});
  for (int i = 0; i < moments; ++i) {
    r.prints.push_back(static_cast<std::uint32_t>(i) * 2654435761u);
    r.moments.push_back({i, i / 240.0, {poseAt(0), poseAt(i * i)}, {{0, 1, 0.25}}});
  }
  r.strikes = {{3, 0.0125, 0, 1, 1.5}};
  r.shots = {{"frame_0001.png",
              0.5,
              0xfedcba9876543210u,
              {},
              {poseAt(0), poseAt(9)},
              4,
              2,
              {-1, -1, -1, 1, 1, 0, 0, 0},
              0x123456789abcdef0u}};
  return r;
}

MotionRecord throughAFile(const MotionRecord& record, std::size_t most) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> bytes = recordBytes(record, most);
  return readRecord(folder.file("states.carom", std::string(bytes.begin(), bytes.end())));
}

TEST(MotionRecord, ComesBackFromItsFile) {
  const MotionRecord r = sampleRecord(20), back = throughAFile(r, kMostRecordBytes);
  EXPECT_EQ(back.scene, r.scene);
  EXPECT_EQ(back.world, r.world);
  EXPECT_EQ(back.sources, r.sources);
  EXPECT_EQ(back.bodies[1].name, r.bodies[1].name);
  EXPECT_EQ(back.bodies[1].stuff, r.bodies[1].stuff);
  EXPECT_EQ(back.prints, r.prints);
  ASSERT_EQ(back.moments.size(), r.moments.size());
  for (std::size_t i = 0; i < r.moments.size(); ++i) {
    EXPECT_EQ(back.moments[i].poses, r.moments[i].poses) << i;
    EXPECT_EQ(back.moments[i].touches.size(), 1u);
  }
  EXPECT_EQ(back.strikes[0].impulse_Ns, 1.5);
  EXPECT_EQ(back.shots[0].state_hash, r.shots[0].state_hash);
  EXPECT_EQ(back.shots[0].text_print, r.shots[0].text_print);
  EXPECT_EQ(back.shots[0].poses, r.shots[0].poses);
  EXPECT_EQ(back.shots[0].bodies, r.shots[0].bodies);
  EXPECT_EQ(back.shots[0].camera.eye, r.shots[0].camera.eye);
}

TEST(MotionRecord, IsThinnedOutUntilItFitsAndKeepsTheShotsAndTheBodies) {
  const MotionRecord r = sampleRecord(3000);
  const std::size_t whole = recordBytes(r).size(), most = whole - 200;
  EXPECT_LE(recordBytes(r, most).size(), most);
  const MotionRecord back = throughAFile(r, most);
  EXPECT_LT(back.moments.size(), 128u);
  EXPECT_EQ(back.moments[1].poses, r.moments[static_cast<std::size_t>(back.moments[1].step)].poses);
  EXPECT_EQ(back.shots[0].poses, r.shots[0].poses);
  EXPECT_EQ(back.bodies.size(), 2u);
}

TEST(MotionRecord, AShotIsOfTheFrameWhoseFileSaysTheSameWhoeverDrewIt) {
  MotionRecord r = sampleRecord(2);
  const renderer::PngText text = {{"Build", "gcc"}, {"Scene", "sample 01"}, {"State", "fedcba9876543210"}};
  renderer::PngText other_build = text, other_scene = text, other_state = text, other_camera = text;
  other_build[0].second = "clang";
  other_scene[1].second = "sample 02";
  other_state[2].second = "fedcba9876543211";
  other_camera.emplace_back("Camera", "side");
  r.shots[0].text_print = textPrint(text);
  const std::string file = r.shots[0].file;
  EXPECT_EQ(r.shotOf(file, text), &r.shots[0]);
  EXPECT_EQ(r.shotOf(file, other_build), &r.shots[0]);
  EXPECT_EQ(r.shotOf("frame_0002.png", text), nullptr);
  for (const renderer::PngText& other : {other_scene, other_state, other_camera, renderer::PngText{}})
    EXPECT_EQ(r.shotOf(file, other), nullptr);
  r.shots[0].text_print = 0;  // of an earlier version: the state must do
  EXPECT_EQ(r.shotOf(file, other_scene), &r.shots[0]);
  EXPECT_EQ(r.shotOf(file, other_state), nullptr);
}

TEST(MotionRecord, OfOtherBodiesThanItsPosesIsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  EXPECT_THROW(readRecord(folder.file("states.carom", "nothing")), InputError);
}

}  // namespace
}  // namespace carom::demos
