#include "demos/compare/cause.h"

#include <gtest/gtest.h>

#include "demos/cause/cause_json.h"
#include "demos/cause/picture_evidence.h"
#include "demos/format/content_hash.h"
#include "tests/demos/support/png_files.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

/// A floor and two crates that fall; the second lands on the floor with 2 N s at 0.1 s.
MotionRecord usual() {
  MotionRecord r;
  r.scene = "crates";
  r.world = {{"gravity", "0 0 -9.81"}, {"step rate", "240"}};
  r.look = {{"light", "0.5 -0.5 0.85"}, {"preset", "realtime"}, {"renderer", "llvmpipe"}};
  r.sources = {{"engine/response/one_point/impulse.cpp", "11111111"},
               {"renderer/passes/surface_pass.cpp", "22222222"}};
  r.step_s = 1.0 / 240.0;
  r.length_quantum_m = 0x1p-14;
  for (const char* name : {"floor", "crate[0]", "crate[1]"})
    r.bodies.push_back({name,
                        {{"position", "0 0 1"}, {"static", name == std::string("floor") ? "true" : "false"}},
                        {{"restitution", "0.2"}, {"density", "800"}},
                        {{"volume", "1"}, {"geometry", "aa"}},
                        {{"color", "#d55e00"}}});
  for (int i = 0; i <= 120; ++i) {
    r.prints.push_back(static_cast<std::uint32_t>(1000 + i));
    r.moments.push_back(
        {i, i / 240.0, {RoundedPose{}, RoundedPose{0, 0, -i, 10000}, RoundedPose{0, 0, -i, 10000}}, {}});
  }
  r.strikes = {{24, 0.1, 0, 2, 2.0}};
  r.shots = {{"f.png", 0.5, 77, {}, r.moments.back().poses, 4, 2, {-1, -1, 1, 1, 0, 0, 2, 2}}};
  return r;
}

/// Other states from step 24 on; the second crate is 1638 quanta, 0.1 m, lower at the frame.
void divert(MotionRecord& r) {
  for (std::size_t i = 24; i < r.prints.size(); ++i) r.prints[i] += 5000;
  for (std::size_t i = 30; i < r.moments.size(); ++i) r.moments[i].poses[2][2] -= 1638;
  r.shots[0].poses[2][2] -= 1638;
  r.shots[0].state_hash = 78;
  r.strikes[0].impulse_Ns = 1.5;
}

constexpr char kSceneText[] = "crates 01", kEditedText[] = "crates 02";

Cause causeOf(const MotionRecord& actual, const std::string& scene = kSceneText) {
  const MotionRecord golden = usual();
  return causeInRecords(
      {RecordedPictures{{actual, actual.shots[0], scene}, {golden, golden.shots[0], kSceneText}}});
}

TEST(Cause, OfTheSameRunIsUnknown) {
  EXPECT_FALSE(causeOf(usual()).known());
}

TEST(Cause, OfAChangeWithoutATraceInTheStatesIsNamedAsThat) {
  MotionRecord now = usual();
  now.bodies[1].stuff[1].second = "900";
  EXPECT_EQ(causeOf(now).headline,
            "the scene changed, though no state did: density of crate[0] is 900, was 800");
}

TEST(Cause, NamesTheBodyThatWasChangedAndWhatFollows) {
  MotionRecord now = usual();
  divert(now);
  now.bodies[2].stuff[0].second = "0.5";
  const Cause cause = causeOf(now);
  EXPECT_EQ(cause.headline, "physics moved: restitution of crate[1] is 0.5, was 0.2");
  EXPECT_EQ(cause.changes[0].part, "material");
  EXPECT_NEAR(cause.since_s, 0.1, 1e-9);
  EXPECT_EQ(cause.first_event, "0.1 s: floor and crate[1] collide with 1.5 N s, was 2 N s");
  ASSERT_EQ(cause.moved.size(), 1u);
  EXPECT_EQ(cause.moved[0].name, "crate[1]");
  EXPECT_NEAR(cause.moved[0].distance_m, 0.1, 1e-4);
  EXPECT_NEAR(cause.moved[0].since_s, 0.125, 1e-9);
  EXPECT_EQ(cause.moved[0].golden.size(), 122u);
  EXPECT_EQ(causeLines(cause)[0], "the states differ since 0.1 s");
}

TEST(Cause, OfOtherStatesOfTheSameSceneIsTheEnginesSource) {
  MotionRecord now = usual();
  divert(now);
  now.sources[0].second = "00000000";
  now.sources[1].second = "00000000";
  EXPECT_EQ(causeOf(now).headline,
            "physics moved: the same scene, other states from step 24 (0.1 s) on; "
            "engine/response/one_point/impulse.cpp changed");
}

// Forces, locked axes and paths are in no record: it said "the same scene, other states" of them.
TEST(Cause, OfOtherStatesOfAnEditedSceneIsTheEdit) {
  MotionRecord now = usual();
  divert(now);
  const Cause cause = causeOf(now, kEditedText);
  EXPECT_EQ(cause.headline, "physics moved: the scene was edited, other states from step 24 (0.1 s) on");
  EXPECT_EQ(cause.changes[0].part, "scene");
  now.sources[0].second = "00000000";
  EXPECT_EQ(causeOf(now, kEditedText).headline,
            "physics moved: the scene was edited, other states from step 24 (0.1 s) on; "
            "engine/response/one_point/impulse.cpp changed");
  now.bodies[2].stuff[0].second = "0.5";
  EXPECT_EQ(causeOf(now, kEditedText).headline, "physics moved: restitution of crate[1] is 0.5, was 0.2");
}

TEST(Cause, NamesAnotherOrderOfTheSameBodies) {
  MotionRecord now = usual();
  divert(now);
  std::swap(now.bodies[1], now.bodies[2]);
  EXPECT_EQ(causeOf(now, kEditedText).headline,
            "physics moved: the bodies are in another order from crate[1] on");
}

TEST(Cause, NamesAMissingBodyThoughAllIndicesShift) {
  MotionRecord now = usual();
  divert(now);
  now.bodies.erase(now.bodies.begin() + 1);
  for (RecordedMoment& m : now.moments) m.poses.erase(m.poses.begin() + 1);
  now.shots[0].poses.erase(now.shots[0].poses.begin() + 1);
  now.strikes[0].body_b = 1;
  const Cause cause = causeOf(now);
  EXPECT_EQ(cause.headline, "physics moved: crate[0] is missing");
  EXPECT_EQ(cause.first_event, "0.1 s: floor and crate[1] collide with 1.5 N s, was 2 N s");
}

TEST(Cause, OfAnotherShapeIsNotSoughtInItsPlace) {
  MotionRecord now = usual();
  divert(now);
  now.bodies[1].shape[1].second = "bb";
  now.bodies[1].motion[0].second = "0 0 1.001";
  EXPECT_EQ(causeOf(now).headline, "physics moved: the shape of crate[0] changed");
}

TEST(Cause, SaysHowFarABodyStartsFromWhereItWas) {
  MotionRecord now = usual();
  divert(now);
  now.bodies[1].motion[0].second = "0.03 0.04 1";
  EXPECT_EQ(causeOf(now).headline,
            "physics moved: crate[0] starts 0.05 m away from where it was (0.03 0.04 1, was 0 0 1)");
}

/// Both frames with the records' state, the second crate's two pixels brighter now.
class FramePair : public testing::Test {
 protected:
  Cause compareWith(const MotionRecord& actual, const MotionRecord& golden = usual()) {
    const renderer::Raster was = flatRaster(4, 2, 100);
    renderer::Raster is = changed(changed(was, 2, 1, 50), 3, 1, 50);
    write("a", is, actual);
    write("g", was, golden);
    Comparison c =
        compared({"f.png", folder_.path() / "a/f.png", folder_.path() / "g/f.png", true, true}, {});
    RecordShelf shelf;
    return causeOfDifference(c, {}, shelf);
  }
  void write(const std::string& side, const renderer::Raster& raster, const MotionRecord& record) {
    writePng(
        folder_.path() / side / "f.png", raster,
        {{"Scene", side == "a" ? scene_now_ : kSceneText}, {"State", hexText(record.shots[0].state_hash)}});
    const std::vector<std::uint8_t> bytes = recordBytes(record);
    folder_.file(side + "/states.carom", std::string(bytes.begin(), bytes.end()));
  }
  TemporaryFolder folder_;
  std::string scene_now_ = kSceneText;
};

TEST_F(FramePair, OfTheSameStatesNamesTheLookAndWhereItLies) {
  MotionRecord now = usual();
  now.bodies[2].look[0].second = "#0072b2";
  const Cause cause = compareWith(now);
  EXPECT_EQ(cause.headline, "the same motion, another look: color of crate[1] is #0072b2, was #d55e00");
  EXPECT_EQ(cause.evidence, "the difference lies on crate[1]");
  ASSERT_EQ(cause.pixels.size(), 1u);
  EXPECT_EQ(cause.pixels[0].pixels, 2);
}

TEST_F(FramePair, OfTheSameLookNamesTheRenderersSource) {
  MotionRecord now = usual();
  now.sources[0].second = "00000000";
  now.sources[1].second = "00000000";
  const Cause cause = compareWith(now);
  EXPECT_EQ(cause.headline,
            "the renderer changed: the same states and look; renderer/passes/surface_pass.cpp changed");
  EXPECT_EQ(cause.changes[0].part, "shader");
}

// The mesh that is drawn and its picture are in no record: it said "the renderer changed" of them.
TEST_F(FramePair, OfAnEditedSceneIsTheEditBeforeTheRenderer) {
  scene_now_ = kEditedText;
  MotionRecord now = usual();
  const Cause cause = compareWith(now);
  EXPECT_EQ(cause.headline, "the same motion, another look: the scene was edited");
  EXPECT_EQ(cause.changes[0].part, "scene");
  now.sources[1].second = "00000000";
  EXPECT_EQ(compareWith(now).headline,
            "the same motion, another look: the scene was edited; renderer/passes/surface_pass.cpp changed");
  now.bodies[2].look[0].second = "#0072b2";
  EXPECT_EQ(compareWith(now).headline,
            "the same motion, another look: color of crate[1] is #0072b2, was #d55e00");
}

TEST_F(FramePair, NamesCameraLightPresetSceneAndMoment) {
  MotionRecord now = usual();
  now.shots[0].camera.eye.x() += 0.5;
  EXPECT_EQ(compareWith(now).changes[0].part, "camera");
  now = usual();
  now.look[0].second = "0.6 -0.5 0.85";
  EXPECT_EQ(compareWith(now).changes[0].part, "light");
  now = usual();
  now.look[1].second = "fast";
  EXPECT_EQ(compareWith(now).changes[0].part, "preset");
  now = usual();
  now.scene = "tower";
  EXPECT_EQ(compareWith(now).headline, "another scene: tower, was crates");
  now = usual();
  now.shots[0].time_s = 0.25;
  EXPECT_EQ(compareWith(now).headline, "another moment: 0.25 s, was 0.5 s");
}

TEST_F(FramePair, TakesNoRecordOfAnotherRunForTheFrames) {
  MotionRecord now = usual();
  now.bodies[2].look[0].second = "#0072b2";
  compareWith(now);
  now.shots[0].state_hash = 5;
  const std::vector<std::uint8_t> bytes = recordBytes(now);
  folder_.file("a/states.carom", std::string(bytes.begin(), bytes.end()));
  Comparison c = compared({"f.png", folder_.path() / "a/f.png", folder_.path() / "g/f.png", true, true}, {});
  const auto headline = [&] {
    RecordShelf shelf;
    return causeOfDifference(c, {}, shelf).headline;
  };
  const auto record = [&](const std::string& side, const MotionRecord& of) {
    const std::vector<std::uint8_t> written = recordBytes(of);
    folder_.file(side + "/states.carom", std::string(written.begin(), written.end()));
  };
  const std::string by_text = "the renderer changed: same state 000000000000004d";
  EXPECT_EQ(headline(), by_text);
  record("a", usual());
  record("g", now);
  EXPECT_EQ(headline(), by_text) << "that of the golden frames";
  now.shots[0].state_hash = usual().shots[0].state_hash;
  now.shots[0].text_print = 1;
  record("g", usual());
  record("a", now);
  EXPECT_EQ(headline(), by_text) << "of the same state, seen by another camera";
  now.shots[0].text_print = 0;
  record("a", now);
  EXPECT_NE(headline(), by_text);
}

TEST(Cause, OfPixelsThatNobodyDrewIsTheFile) {
  const renderer::Raster pixels = flatRaster(4, 2, 100);
  std::vector<std::uint8_t> bytes(pixels.samples.begin(), pixels.samples.end());
  const std::string signature = hexText(ContentHash().add(bytes.data(), bytes.size()).value());
  const renderer::DecodedRaster whole{pixels, {{"Scene", "a 1"}, {"State", "1"}, {"Pixels", signature}}};
  renderer::DecodedRaster damaged = whole;
  damaged.raster.samples[3] = 7;
  EXPECT_EQ(causeByText(damaged, whole).changes[0].part, "encoder");
  EXPECT_EQ(causeByText(whole, damaged).changes[0].name, "golden");
  EXPECT_EQ(causeByText(whole, whole).changes[0].part, "renderer");
}

}  // namespace
}  // namespace carom::demos
