#include "demos/page/page_pictures.h"

#include <algorithm>
#include <string>

namespace carom::demos {
namespace {

constexpr std::size_t kChannels = 3;

/// All layers one below the other.
SurfacePicture stacked(const std::vector<SurfacePicture>& pictures, const renderer::PictureSize& size) {
  SurfacePicture all{size.width, size.height * static_cast<int>(pictures.size()), {}};
  for (const SurfacePicture& picture : pictures) {
    const SurfacePicture layer = renderer::resizedPicture(picture, size.width, size.height);
    all.rgb.insert(all.rgb.end(), layer.rgb.begin(), layer.rgb.end());
  }
  return all;
}

}  // namespace

int foretold(int left, int above, int corner) {
  const auto [least, most] = std::minmax(left, above);
  if (corner >= most) return least;
  return corner <= least ? most : left + above - corner;
}

int PagePictures::add(const SurfacePicture& picture) {
  const auto known = std::find(pictures_.begin(), pictures_.end(), picture);
  if (known != pictures_.end()) return static_cast<int>(known - pictures_.begin());
  if (pictures_.size() == kMostLayers) return -1;
  pictures_.push_back(picture);
  return static_cast<int>(pictures_.size() - 1);
}

void PagePictures::write(ByteStream& out) const {
  out.add(static_cast<std::int64_t>(pictures_.size()));
  if (pictures_.empty()) return;
  const renderer::PictureSize size = renderer::layerSize(pictures_, kBounds);
  out.add(size.width);
  out.add(size.height);
  const SurfacePicture all = stacked(pictures_, size);
  const std::size_t row = kChannels * static_cast<std::size_t>(all.width);
  std::string bytes;
  bytes.reserve(all.rgb.size());
  for (std::size_t i = 0; i < all.rgb.size(); ++i) {
    const bool has_left = i % row >= kChannels, has_above = i >= row;
    const int left = has_left ? all.rgb[i - kChannels] : 0;
    const int above = has_above ? all.rgb[i - row] : 0;
    const int corner = has_left && has_above ? all.rgb[i - row - kChannels] : 0;
    bytes.push_back(static_cast<char>((all.rgb[i] - foretold(left, above, corner)) & 255));
  }
  out.addBytes(bytes);
}

}  // namespace carom::demos
