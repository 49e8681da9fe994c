#include "demos/compare/picture_mask.h"

#include <gtest/gtest.h>

#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"
#include "renderer/image/image_difference.h"
#include "tests/demos/support/png_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

class Masked : public testing::Test {
 protected:
  /// How many pixels still differ where all do.
  long long left(const std::vector<std::string>& masks) {
    const PictureMask mask(masks, shelf_);
    renderer::Raster actual = flatRaster(20, 10, 50);
    const renderer::Raster golden = flatRaster(20, 10, 90);
    mask.apply({"f.png", folder_.path() / "a/f.png", folder_.path() / "g/f.png", true, true}, actual, golden);
    return renderer::differenceOf(actual, golden, 2).pixels_beyond;
  }
  /// A frame of that state in `side`, and beside it a record of state 1 with the crate at column `x`.
  void writeFrame(const std::string& side, int state, int x) {
    writePng(folder_.path() / side / "f.png", flatRaster(20, 10, 50),
             {{"State", "000000000000000" + std::to_string(state)}});
    writeRecord(side, x);
  }
  void writeRecord(const std::string& side, int x) {
    MotionRecord record;
    for (const char* name : {"floor", "crate"}) record.bodies.push_back({name, {}, {}, {}, {}});
    RecordedShot shot{"f.png", 0.0, 1, {}, {{}, {}}, 20, 10, std::vector<std::int32_t>(200, 0)};
    shot.bodies[static_cast<std::size_t>(5 * 20 + x)] = 1;
    record.shots = {shot};
    const std::vector<std::uint8_t> bytes = recordBytes(record);
    folder_.file(side + "/states.carom", std::string(bytes.begin(), bytes.end()));
  }
  TemporaryFolder folder_;
  RecordShelf shelf_;
};

TEST_F(Masked, RectanglesBodiesAndImagesAreNotLookedAt) {
  writeFrame("a", 1, 10);
  EXPECT_EQ(left({}), 200);
  EXPECT_EQ(left({"rect:2,3,4,5"}), 180);
  EXPECT_EQ(left({"rect:15,5,100,100"}), 175);
  EXPECT_EQ(left({"body:crate"}), 175);  // the pixel and two around it
  EXPECT_EQ(left({"body:crate", "rect:0,0,1,1"}), 174);
  const auto png = writePng(folder_.path() / "mask.png", changed(flatRaster(20, 10, 0), 3, 3, 255));
  EXPECT_EQ(left({"png:" + png.string()}), 199);
}

// A run without a record leaves that of the run before: its crate hid what was new elsewhere.
TEST_F(Masked, ABodyIsWhereTheRecordsOfTheseVeryFramesHaveIt) {
  writeFrame("g", 1, 3);
  writeFrame("a", 1, 16);
  EXPECT_EQ(left({"body:crate"}), 150) << "now and then";
  writeFrame("a", 2, 16);
  EXPECT_EQ(left({"body:crate"}), 175) << "then alone";
  writeFrame("g", 2, 3);
  EXPECT_NE(thrownMessage<InputError>([&] { left({"body:crate"}); }).find("no record of f.png as it is"),
            std::string::npos);
}

// Grey against colours, and no alpha against alpha, are compared; so masks hold there as well.
TEST_F(Masked, ImagesOfOtherChannelsAreMasked) {
  const PictureMask mask({"rect:2,3,4,5"}, shelf_);
  const renderer::Raster rgb = flatRaster(20, 10, 50);
  const renderer::Raster grey{20, 10, 1, 8, std::vector<std::uint16_t>(200, 90)};
  renderer::Raster clear{20, 10, 4, 8, std::vector<std::uint16_t>(800, 90)};
  const renderer::Raster rasters[] = {rgb, grey, clear};
  for (const renderer::Raster& golden : rasters)
    for (const renderer::Raster& given : rasters) {
      if (given.channels == golden.channels) continue;
      renderer::Raster actual = given;
      mask.apply({"f.png", "a/f.png", "g/f.png", true, true}, actual, golden);
      EXPECT_EQ(renderer::differenceOf(actual, golden, 2).pixels_different, 180)
          << given.channels << " of " << golden.channels;
    }
}

TEST_F(Masked, WhatCannotBeMaskedIsSaid) {
  for (const char* text : {"", "crate", "rect:1,2,3", "rect:1,2,0,4", "rect:1,2,3,4,5", "body:", "png:"})
    EXPECT_NE(thrownMessage<UsageError>([&] { left({text}); }).find("accepted: body:NAME"), std::string::npos)
        << text;
  EXPECT_NE(thrownMessage<InputError>([&] { left({"body:crate"}); }).find("--states"), std::string::npos);
  writeFrame("a", 1, 10);
  EXPECT_THROW(left({"body:barrel"}), InputError);
  const auto png = writePng(folder_.path() / "mask.png", flatRaster(4, 4, 255));
  EXPECT_NE(thrownMessage<InputError>([&] { left({"png:" + png.string()}); }).find("accepted: the size"),
            std::string::npos);
  for (const char* text : {"rect:20,0,5,5", "rect:0,10,5,5"})
    EXPECT_EQ(thrownMessage<InputError>([&] { left({text}); }),
              std::string("--mask ") + text + ": lies beyond f.png; accepted: within 20x10");
}

TEST_F(Masked, NothingLeftToCompareIsNoSuccess) {
  EXPECT_EQ(left({"rect:0,0,20,9", "rect:0,9,19,1"}), 1);
  EXPECT_NE(thrownMessage<InputError>([&] {
              left({"rect:0,0,20,9", "rect:0,9,20,1"});
            }).find("f.png is left"),
            std::string::npos);
}

}  // namespace
}  // namespace carom::demos
