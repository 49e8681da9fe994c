#include "demos/compare/comparison.h"

#include <gtest/gtest.h>

#include "demos/compare/comparison_run.h"
#include "tests/demos/support/png_files.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;
using renderer::PngText;
using renderer::Raster;

class Judged : public testing::Test {
 protected:
  ImagePair pair(const Raster& actual, const Raster& golden, const PngText& a = {},
                 const PngText& g = {}) const {
    return {"f.png", writePng(folder_.path() / "a/f.png", actual, a),
            writePng(folder_.path() / "g/f.png", golden, g), true, true};
  }
  Verdict verdict(const Raster& actual, const Raster& golden, const Gate& gate = {}) const {
    return compared(pair(actual, golden), gate).verdict;
  }
  TemporaryFolder folder_;
};

TEST_F(Judged, TheGateIsTheLargestDifferenceOfAnyChannel) {
  const Raster golden = flatRaster(40, 30, 100);
  EXPECT_EQ(verdict(golden, golden), Verdict::kSame);
  EXPECT_EQ(verdict(flatRaster(40, 30, 102), golden),
            Verdict::kWithin);  // every pixel, but by no more than 2/255
  EXPECT_EQ(verdict(changed(golden, 39, 29, 3), golden), Verdict::kBeyond);
  EXPECT_EQ(verdict(changed(golden, 39, 29, 3), golden, {3, 0, 0}), Verdict::kWithin);
}

TEST_F(Judged, AsManyPixelsAsAllowedMayDifferByMore) {
  const Raster golden = flatRaster(40, 30, 100);
  const Raster actual = changed(changed(golden, 0, 0, 90), 5, 5, 90);
  EXPECT_EQ(verdict(actual, golden, {2, 0, 1}), Verdict::kBeyond);
  EXPECT_EQ(verdict(actual, golden, {2, 0, 2}), Verdict::kWithin);
}

TEST_F(Judged, TheNeighboursIdIsAnotherIdUnlessAllowed) {
  const Raster ids = flatRaster(8, 8, 3, 1, 16);
  EXPECT_EQ(verdict(changed(ids, 4, 4, 1), ids), Verdict::kBeyond);
  EXPECT_EQ(verdict(changed(ids, 4, 4, 1), ids, {2, 1, 0}), Verdict::kWithin);
}

TEST_F(Judged, OtherSizesAndBitsAreNeverEqual) {
  const Gate lax{255, 65535, 1000000};
  const Raster golden = flatRaster(8, 6, 0);
  EXPECT_EQ(verdict(flatRaster(6, 8, 0), golden, lax), Verdict::kShape);
  EXPECT_EQ(verdict(flatRaster(8, 6, 0, 3, 16), golden, lax), Verdict::kShape);
  EXPECT_EQ(comparisonLine(compared(pair(flatRaster(6, 8, 0), golden), lax), lax),
            "size differs  6x8 8-bit RGB, golden 8x6 8-bit RGB");
}

TEST_F(Judged, AnUnreadableFileIsAVerdictThatNamesIt) {
  const Raster golden = flatRaster(40, 30, 100);
  const ImagePair files = pair(golden, golden);
  truncateFile(files.actual);
  const Comparison c = compared(files, {});
  EXPECT_EQ(c.verdict, Verdict::kUnreadable);
  EXPECT_NE(c.problem.find(files.actual.string() + "': the file is truncated"), std::string::npos)
      << c.problem;
  EXPECT_FALSE(c.actual_shape);
  EXPECT_TRUE(c.golden_shape);
  // Also where there is nothing to compare it with.
  EXPECT_EQ(compared({"f.png", files.actual, files.golden, true, false}, {}).verdict, Verdict::kUnreadable);
}

TEST_F(Judged, TwoCopiesOfABrokenFileAreNotTheSame) {
  const ImagePair files = pair(flatRaster(40, 30, 100), flatRaster(40, 30, 100));
  EXPECT_EQ(compared(files, {}).verdict, Verdict::kSame);
  truncateFile(files.actual);
  truncateFile(files.golden);
  const Comparison c = compared(files, {});
  EXPECT_EQ(c.verdict, Verdict::kUnreadable);
  EXPECT_FALSE(c.actual_shape || c.golden_shape);
}

TEST_F(Judged, FilesOfOtherBytesButTheSamePixelsAreTheSame) {
  const Raster golden = flatRaster(40, 30, 100);
  EXPECT_EQ(compared(pair(golden, golden, {{"State", "a"}}, {{"State", "b"}}), {}).verdict, Verdict::kSame);
}

TEST_F(Judged, PhysicsIsToldFromRendererByTheStateInTheFrames) {
  const Raster golden = flatRaster(8, 6, 9), actual = flatRaster(8, 6, 99);
  const PngText then{{"Scene", "ball 01"}, {"State", "aa"}};
  const auto cause = [&](const PngText& now, const PngText& before) {
    return compared(pair(actual, golden, now, before), {}).cause.headline;
  };
  EXPECT_EQ(cause(then, then), "the renderer changed: same state aa");
  EXPECT_EQ(cause({{"Scene", "ball 01"}, {"State", "bb"}}, then), "physics moved: state aa became bb");
  EXPECT_EQ(cause({{"Scene", "ball 02"}, {"State", "bb"}}, then), "the scene was edited");
  EXPECT_EQ(cause({}, then), "");
  EXPECT_EQ(compared(pair(golden, golden, {{"State", "bb"}}, then), {}).cause.headline,
            "");  // nothing to explain
}

TEST_F(Judged, ALookThatTheFramesTellOfIsNoOtherRenderer) {
  const Raster golden = flatRaster(8, 6, 9), actual = flatRaster(8, 6, 99);
  const auto cause = [&](const PngText& more_now, const PngText& more_then) {
    PngText now{{"State", "aa"}}, then = now;
    now.insert(now.end(), more_now.begin(), more_now.end());
    then.insert(then.end(), more_then.begin(), more_then.end());
    return compared(pair(actual, golden, now, then), {}).cause.headline;
  };
  const std::string look = "the same motion, another look: ";
  EXPECT_EQ(cause({{"Caption", "on"}}, {}), look + "Caption is on, was off");
  EXPECT_EQ(cause({{"Portable", "no"}}, {}), look + "Portable is no, was yes");
  EXPECT_EQ(cause({}, {{"Portable", "no"}}), look + "Portable is yes, was no");
  EXPECT_EQ(cause({}, {{"Preset", "fast"}}), look + "Preset is the usual one, was fast");
}

// Frames of another moment or camera have other states or pixels without anything having moved or changed.
TEST_F(Judged, AnotherCameraOrTimeIsNeitherPhysicsNorRenderer) {
  const Raster golden = flatRaster(8, 6, 9), actual = flatRaster(8, 6, 99);
  const PngText then{{"Renderer", "old"}, {"Camera", "main"}, {"Time", "0.5"}, {"State", "aa"}};
  const auto cause = [&](const std::string& key, const std::string& value) {
    PngText now = then;
    for (auto& [name, text] : now)
      if (name == key) text = value;
    return compared(pair(actual, golden, now, then), {}).cause.headline;
  };
  EXPECT_EQ(cause("Camera", "side"), "another camera: main became side");
  EXPECT_EQ(cause("Time", "0.4"), "another time: 0.5 became 0.4 s");
  EXPECT_EQ(cause("State", "bb"), "physics moved: state aa became bb");
  EXPECT_EQ(cause("Renderer", "new"), "the renderer changed: same state aa, old became new");
}

TEST_F(Judged, SeveritySortsByVerdictThenPixelsThenDifferenceThenName) {
  const auto made = [](const std::string& name, Verdict verdict, std::int64_t beyond, int largest) {
    Comparison c;
    c.pair.name = name;
    c.verdict = verdict;
    c.difference.pixels_beyond = beyond;
    c.difference.largest = largest;
    return c;
  };
  const std::vector<Comparison> all = {
      made("same", Verdict::kSame, 0, 0),    made("few", Verdict::kBeyond, 5, 255),
      made("b", Verdict::kBeyond, 50, 9),    made("a", Verdict::kBeyond, 50, 9),
      made("c", Verdict::kBeyond, 50, 10),   made("within", Verdict::kWithin, 0, 2),
      made("gone", Verdict::kMissing, 0, 0), made("broken", Verdict::kUnreadable, 0, 0),
      made("size", Verdict::kShape, 0, 0),   made("new", Verdict::kExtra, 0, 0)};
  std::string order;
  for (const std::size_t i : bySeverity(all)) order += all[i].pair.name + " ";
  EXPECT_EQ(order, "broken size gone new c a b few within same ");
  EXPECT_EQ(tallyText(tallyOf(all)),
            "2 of 10 pass, 4 differ, 1 of another size, 1 missing, 1 extra, 1 unreadable");
}

TEST_F(Judged, ManyPairsComeBackInTheirOrderAndAreCounted) {
  std::vector<ImagePair> pairs;
  const Raster golden = flatRaster(9, 7, 50);
  for (int i = 0; i < 60; ++i) {
    const std::string name = std::to_string(i) + ".png";
    pairs.push_back({name, writePng(folder_.path() / "a" / name, flatRaster(9, 7, std::uint16_t(50 + i))),
                     writePng(folder_.path() / "g" / name, golden), true, true});
  }
  int told = 0;
  const std::vector<Comparison> all =
      comparedPairs(pairs, {}, [&told](int count) { EXPECT_EQ(count, ++told); });
  EXPECT_EQ(told, 60);
  ASSERT_EQ(all.size(), 60u);
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(all[std::size_t(i)].pair.name, std::to_string(i) + ".png");
    EXPECT_EQ(all[std::size_t(i)].difference.largest, i);
  }
}

TEST_F(Judged, WhatTheThreadsAreToldToThrowArrives) {
  const Raster golden = flatRaster(9, 7, 50);
  const std::vector<ImagePair> pairs(40, pair(golden, golden));
  EXPECT_THROW(comparedPairs(pairs, {},
                             [](int count) {
                               if (count == 3) throw std::runtime_error("stop");
                             }),
               std::runtime_error);
}

}  // namespace
}  // namespace carom::demos
