#include "renderer/view/multiple_exposure.h"

#include <array>
#include <cmath>

#include "engine/foundation/contract.h"
#include "renderer/view/view.h"

namespace carom::renderer {
namespace {

// sRGB bytes to linear light in 16 bits, and back to the nearest byte.
struct Tables {
  std::array<std::uint16_t, 256> linear{};
  std::vector<std::uint8_t> encoded = std::vector<std::uint8_t>(65536);
  Tables() {
    const auto light = [](float byte) { return std::lround(65535.0f * linearLight(byte / 255.0f)); };
    std::size_t from = 0;
    for (std::size_t i = 0; i < linear.size(); ++i) {
      linear[i] = static_cast<std::uint16_t>(light(static_cast<float>(i)));
      const std::size_t to =
          i == 255 ? encoded.size() : static_cast<std::size_t>(light(static_cast<float>(i) + 0.5f));
      for (; from < to; ++from) encoded[from] = static_cast<std::uint8_t>(i);
    }
  }
};

const Tables& tables() {
  static const Tables instance;
  return instance;
}

}  // namespace

void MultipleExposure::add(const Image& image) {
  if (count_ == 0) light_.assign(image.rgb.size(), 0);
  REQUIRE(light_.size() == image.rgb.size() && count_ < 65536, light_.size(), image.rgb.size(), count_);
  const std::array<std::uint16_t, 256>& linear = tables().linear;
  for (std::size_t i = 0; i < light_.size(); ++i) light_[i] += linear[image.rgb[i]];
  if (count_ == 0) alpha_.assign(image.alpha.size(), 0);
  REQUIRE(alpha_.size() == image.alpha.size(), alpha_.size(), image.alpha.size());
  for (std::size_t i = 0; i < alpha_.size(); ++i) alpha_[i] += image.alpha[i];
  ++count_;
}

void MultipleExposure::develop(Image& image) {
  REQUIRE(count_ > 0 && light_.size() == image.rgb.size(), count_, light_.size(), image.rgb.size());
  const std::vector<std::uint8_t>& encoded = tables().encoded;
  for (std::size_t i = 0; i < light_.size(); ++i) image.rgb[i] = encoded[(light_[i] + count_ / 2) / count_];
  for (std::size_t i = 0; i < alpha_.size(); ++i)
    image.alpha[i] = static_cast<std::uint8_t>((alpha_[i] + count_ / 2) / count_);
  count_ = 0;
}

}  // namespace carom::renderer
