#include "demos/compare/picture_mask.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"
#include "renderer/image/image_difference.h"
#include "renderer/image/png.h"

namespace carom::demos {

struct PictureMask::Rule {
  std::string text;
  std::string body;  ///< Empty: one of the others.
  int x = 0, y = 0, width = 0, height = 0;
  std::optional<renderer::Raster> image;
};

namespace {

constexpr int kAround = 2;  // pixels

/// Calls `mark(pixel)` for those on the body and `kAround` around them.
template <typename Mark>
void markBody(const RecordedShot& shot, std::int32_t body, const Mark& mark) {
  for (int y = 0; y < shot.height; ++y)
    for (int x = 0; x < shot.width; ++x) {
      if (shot.bodies[static_cast<std::size_t>(y * shot.width + x)] != body) continue;
      for (int v = std::max(0, y - kAround); v <= std::min(shot.height - 1, y + kAround); ++v)
        for (int u = std::max(0, x - kAround); u <= std::min(shot.width - 1, x + kAround); ++u)
          mark(static_cast<std::size_t>(v * shot.width + u));
    }
}

bool isMarked(const renderer::Raster& image, std::size_t pixel) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t colors = channels - (channels % 2 == 0 ? 1 : 0);  // without alpha
  for (std::size_t c = 0; c < colors; ++c)
    if (image.samples[pixel * channels + c] != 0) return true;
  return false;
}

}  // namespace

PictureMask::PictureMask(const std::vector<std::string>& texts, RecordShelf& shelf)
    : texts_(texts), shelf_(shelf) {
  for (const std::string& text : texts) {
    Rule rule;
    rule.text = text;
    char rest = 0;
    if (text.rfind("body:", 0) == 0 && text.size() > 5) {
      rule.body = text.substr(5);
    } else if (text.rfind("png:", 0) == 0 && text.size() > 4) {
      rule.image = renderer::readPngRaster(text.substr(4)).raster;
    } else if (std::sscanf(text.c_str(), "rect:%d,%d,%d,%d%c", &rule.x, &rule.y, &rule.width, &rule.height,
                           &rest) != 4 ||
               rule.width <= 0 || rule.height <= 0 || rule.x < 0 || rule.y < 0) {
      throw UsageError("--mask " + text + ": accepted: body:NAME, rect:X,Y,W,H or png:FILE");
    }
    rules_.push_back(std::move(rule));
  }
}

PictureMask::~PictureMask() = default;

void PictureMask::maskBody(const std::string& body, const ImagePair& pair, std::vector<bool>& masked,
                           int width) const {
  const std::lock_guard lock(reading_);
  bool known = false;
  for (const std::optional<RecordedPicture>& picture : {shelf_.ofActual(pair), shelf_.ofGolden(pair)}) {
    if (!picture) continue;
    const RecordedShot& shot = picture->shot;
    if (shot.width != width || shot.bodies.size() != masked.size()) continue;
    const std::vector<RecordedBody>& bodies = picture->record.bodies;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (bodies[b].name != body) continue;
      known = true;
      markBody(shot, static_cast<std::int32_t>(b), [&](std::size_t i) { masked[i] = true; });
    }
  }
  if (!known)
    throw InputError("--mask body:" + body + ": no record of " + pair.name +
                     " as it is knows it; accepted: a body of frames drawn with --states or --portable");
}

std::vector<bool> PictureMask::maskedPixels(const ImagePair& pair, int width, int height) const {
  std::vector<bool> masked(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), false);
  for (const Rule& rule : rules_) {
    if (rule.image) {
      if (rule.image->width != width || rule.image->height != height)
        throw InputError("--mask " + rule.text + ": " + std::to_string(rule.image->width) + "x" +
                         std::to_string(rule.image->height) + "; accepted: the size of " + pair.name + ", " +
                         std::to_string(width) + "x" + std::to_string(height));
      for (std::size_t i = 0; i < masked.size(); ++i) masked[i] = masked[i] || isMarked(*rule.image, i);
    } else if (!rule.body.empty()) {
      maskBody(rule.body, pair, masked, width);
    } else {
      if (rule.x >= width || rule.y >= height)
        throw InputError("--mask " + rule.text + ": lies beyond " + pair.name + "; accepted: within " +
                         std::to_string(width) + "x" + std::to_string(height));
      for (int y = rule.y; y - rule.y < rule.height && y < height; ++y)
        for (int x = rule.x; x - rule.x < rule.width && x < width; ++x)
          masked[static_cast<std::size_t>(y * width + x)] = true;
    }
  }
  if (std::find(masked.begin(), masked.end(), false) == masked.end())
    throw InputError("--mask: nothing of " + pair.name + " is left to compare; accepted: masks of less");
  return masked;
}

void PictureMask::apply(const ImagePair& pair, renderer::Raster& actual,
                        const renderer::Raster& golden) const {
  if (!any() || !renderer::comparable(actual, golden)) return;
  const std::vector<bool> masked = maskedPixels(pair, actual.width, actual.height);
  const renderer::Raster wanted = renderer::inCommonChannels(golden, actual);
  if (actual.channels != wanted.channels) actual = renderer::inCommonChannels(actual, golden);
  const auto channels = static_cast<std::size_t>(wanted.channels);
  for (std::size_t i = 0; i < masked.size(); ++i)
    if (masked[i])
      for (std::size_t c = i * channels; c < (i + 1) * channels; ++c) actual.samples[c] = wanted.samples[c];
}

}  // namespace carom::demos
