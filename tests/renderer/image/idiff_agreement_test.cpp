// The figures of renderer/image/image_difference.h against OpenImageIO's idiff, on files. Needs Debian's
// openimageio-tools; without it the test is skipped.
#include "renderer/image/image_difference.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <regex>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "renderer/image/png.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace carom::renderer {
namespace {
namespace fs = std::filesystem;

double numberAfter(const std::string& text, const std::string& label) {
  std::smatch match;
  const std::regex pattern(label + R"(\s*=\s*([-+0-9.e]+))");
  return std::regex_search(text, match, pattern) ? std::stod(match[1]) : -1.0;
}

/// Of "  12 pixels (0.3%) over 0.0098", the line of the failure threshold, which is the last.
long pixelsOver(const std::string& text) {
  long count = 0;
  const std::regex pattern(R"((\d+) pixels \([^)]*\) over)");
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    count = std::stol((*it)[1]);
  return count;
}

struct Pair {
  Raster a, b;
};

/// A third of the pairs are equal but for a step or two, the others differ in blotches; 8 and 16 bits, grey
/// and RGB.
Pair randomPair(unsigned seed) {
  std::mt19937 random(1000 + seed);
  const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  Raster a{20 + below(80), 20 + below(60), below(3) == 0 ? 1 : 3, below(3) == 0 ? 16 : 8, {}};
  for (int i = 0; i < a.width * a.height * a.channels; ++i)
    a.samples.push_back(static_cast<std::uint16_t>(below(a.fullScale() + 1)));
  Raster b = a;
  const int most = seed % 3 == 0 ? 2 : a.fullScale() / 3;
  for (int k = seed % 7 == 0 ? 0 : 1 + below(300); k > 0; --k) {
    std::uint16_t& s = b.samples[static_cast<std::size_t>(below(static_cast<int>(b.samples.size())))];
    const int step = below(2 * most + 1) - most;
    s = static_cast<std::uint16_t>(std::clamp(s + step, 0, a.fullScale()));
  }
  return {a, b};
}

void write(const fs::path& path, const Raster& raster) {
  const std::vector<std::uint8_t> bytes = encodePng(raster);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

TEST(ImageDifference, AgreesWithIdiffOn100Pairs) {
  if (!succeeds("idiff --help")) GTEST_SKIP() << "idiff is not installed (Debian: openimageio-tools)";
  const TemporaryFolder made;
  const fs::path& folder = made.path();
  int failed = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const Pair pair = randomPair(seed);
    write(folder / "a.png", pair.a);
    write(folder / "b.png", pair.b);
    const int tolerance = pair.a.bits == 8 ? 2 : 700;
    const ImageDifference d = differenceOf(pair.a, pair.b, tolerance);
    // Half a step above the tolerance, so that rounding to float decides nothing.
    const std::string threshold = std::to_string((tolerance + 0.5) / d.full_scale);
    const ShellEnd said = endOfShell("idiff -warn 1 -fail " + threshold + " " + (folder / "a.png").string() +
                                     " " + (folder / "b.png").string() + " 2>&1");
    EXPECT_EQ(said.code == 0, d.pixels_beyond == 0) << said.out;
    failed += said.code == 0 ? 0 : 1;
    if (said.code == 0) continue;  // it prints no figures then
    // idiff prints six significant digits or so of figures between 0 and 1.
    EXPECT_NEAR(numberAfter(said.out, "Max error"), static_cast<double>(d.largest) / d.full_scale, 2e-6)
        << said.out;
    EXPECT_NEAR(numberAfter(said.out, "Mean error"), d.mean / d.full_scale,
                1e-5 * d.mean / d.full_scale + 1e-9)
        << said.out;
    EXPECT_EQ(pixelsOver(said.out), d.pixels_beyond) << said.out;
  }
  EXPECT_GT(failed, 20);
  EXPECT_LT(failed, 80);
}

}  // namespace
}  // namespace carom::renderer
