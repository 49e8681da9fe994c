// What a comparison report holds; how it behaves in a browser is report_browser_test.cpp's.
#include "demos/report/comparison_report.h"

#include <regex>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/format/base64.h"
#include "demos/format/json.h"
#include "demos/system/exit_code.h"
#include "tests/demos/support/png_files.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;
using renderer::Raster;

/// The data of the script element with that id.
Json dataOf(const std::string& page, const std::string& id) {
  const std::string opening = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t from = page.find(opening);
  if (from == std::string::npos) return {};
  const std::size_t start = from + opening.size();
  return Json::parse(page.substr(start, page.find("</script>", start) - start), id);
}

class Report : public testing::Test {
 protected:
  void add(const std::string& name, const Raster& actual, const Raster& golden) {
    const ImagePair pair{name, writePng(folder_.path() / "a" / name, actual),
                         writePng(folder_.path() / "g" / name, golden), true, true};
    comparisons_.push_back(compared(pair, plan_.gate));
  }
  std::string page() const {
    writeComparisonReport(folder_.path() / "report.html", comparisons_, plan_);
    return readTextFile(folder_.path() / "report.html");
  }
  /// The image behind a data: address.
  Raster imageIn(const std::string& address) const {
    const fs::path path = folder_.path() / "embedded.png";
    const std::string prefix = "data:image/png;base64,";
    EXPECT_EQ(address.rfind(prefix, 0), 0u);
    std::ofstream file(path, std::ios::binary);
    std::array<int, 256> value{};
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i)
      value[static_cast<unsigned char>(digits[i])] = static_cast<int>(i);
    for (std::size_t at = prefix.size(); at < address.size(); at += 4) {
      int bits = 0;
      for (std::size_t i = 0; i < 4; ++i)
        bits = bits << 6 | value[static_cast<unsigned char>(address[at + i])];
      for (const int shift : {16, 8, 0}) file.put(static_cast<char>(bits >> shift & 255));
    }
    file.close();
    return renderer::readPngRaster(path).raster;
  }

  TemporaryFolder folder_;
  ReportPlan plan_{"a", "g", {}, 20, 16, false};
  std::vector<Comparison> comparisons_;
};

TEST_F(Report, ListsThePairsWorstFirstWithTheirImages) {
  const Raster golden = flatRaster(6, 5, 100);
  add("same.png", golden, golden);
  add("little.png", changed(golden, 1, 1, 9), golden);
  add("much.png", flatRaster(6, 5, 180), golden);
  const std::string html = page();
  const Json facts = dataOf(html, "facts");
  EXPECT_EQ(facts.at("summary").asString(), "1 of 3 pass, 2 differ");
  ASSERT_EQ(facts.at("pairs").items().size(), 3u);
  EXPECT_EQ(facts.at("pairs").items()[0].at("name").asString(), "much.png");
  EXPECT_EQ(facts.at("pairs").items()[1].at("name").asString(), "little.png");
  const Json images = dataOf(html, "images-1");
  EXPECT_EQ(imageIn(images.at("golden").asString()).samples, golden.samples);
  EXPECT_EQ(imageIn(images.at("actual").asString()).samples, changed(golden, 1, 1, 9).samples);
  EXPECT_EQ(imageIn(images.at("difference").asString()).samples,
            changed(flatRaster(6, 5, 0), 1, 1, 144).samples);
  EXPECT_EQ(dataOf(html, "images-2").kind(), Json::Kind::kNull);  // the same: nothing to show
}

TEST_F(Report, NeedsNothingFromOutside) {
  add("f.png", flatRaster(6, 5, 0), flatRaster(6, 5, 50));
  // The name of SVG's elements looks like an address, and nobody asks for it.
  const std::string html = std::regex_replace(page(), std::regex("\"http://www.w3.org/2000/svg\""), "");
  EXPECT_FALSE(std::regex_search(html, std::regex("https?://|src=\"|href=|@import|url\\(|//cdn")));
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  EXPECT_NE(html.find("prefers-color-scheme: dark"), std::string::npos);
}

TEST_F(Report, HoldsTheImagesOfTheWorstOnly) {
  plan_.embedded = 2;
  for (int i = 0; i < 5; ++i)
    add(std::to_string(i) + ".png", flatRaster(6, 5, std::uint16_t(20 + i)), flatRaster(6, 5, 0));
  const std::string html = page();
  EXPECT_EQ(dataOf(html, "facts").at("pairs").items().size(), 5u);
  EXPECT_NE(dataOf(html, "images-1").kind(), Json::Kind::kNull);
  EXPECT_EQ(dataOf(html, "images-2").kind(), Json::Kind::kNull);
}

TEST_F(Report, ShowsSixteenBitImagesStretchedByTheSameRange) {
  const Raster golden = changed(flatRaster(3, 1, 1000, 1, 16), 2, 0, 200);  // 1000 1000 1200
  add("depth.png", changed(golden, 1, 0, 100), golden);                     // 1000 1100 1200
  const Json images = dataOf(page(), "images-0");
  EXPECT_EQ(imageIn(images.at("golden").asString()).samples, (std::vector<std::uint16_t>{0, 0, 255}));
  EXPECT_EQ(imageIn(images.at("actual").asString()).samples, (std::vector<std::uint16_t>{0, 127, 255}));
  EXPECT_NE(images.at("note").asString().find("1000 to 1200"), std::string::npos);
}

TEST_F(Report, OfOtherSizesShowsBothAndNoDifference) {
  add("f.png", flatRaster(6, 5, 0), flatRaster(5, 6, 0));
  const Json images = dataOf(page(), "images-0");
  EXPECT_NE(images.find("golden"), nullptr);
  EXPECT_NE(images.find("actual"), nullptr);
  EXPECT_EQ(images.find("difference"), nullptr);
}

TEST_F(Report, ANameCannotBreakOutOfTheData) {
  const std::string name = "<script>alert(1)<!--.png";  // '/' cannot be in a file's name
  add(name, flatRaster(6, 5, 0), flatRaster(6, 5, 50));
  const std::string html = page();
  EXPECT_EQ(html.find("alert(1)<"), std::string::npos);
  EXPECT_EQ(dataOf(html, "facts").at("pairs").items()[0].at("name").asString(), name);
}

TEST_F(Report, TheSameComparisonGivesTheSameBytes) {
  add("f.png", flatRaster(6, 5, 0), flatRaster(6, 5, 50));
  const std::string first = page();
  EXPECT_EQ(page(), first);
}

TEST_F(Report, ImagesThatHaveGoneAreLeftOut) {
  add("f.png", flatRaster(6, 5, 0), flatRaster(6, 5, 50));
  fs::remove(folder_.path() / "a/f.png");
  const Json images = dataOf(page(), "images-0");
  EXPECT_EQ(images.find("actual"), nullptr);
  EXPECT_NE(images.find("golden"), nullptr);
}

TEST_F(Report, WhereItCannotBeWrittenItSaysSo) {
  const fs::path below_a_file = folder_.file("file", "") / "report.html";
  EXPECT_THROW(writeComparisonReport(below_a_file, comparisons_, plan_), CannotWrite);
}

}  // namespace
}  // namespace carom::demos
