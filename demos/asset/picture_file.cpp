#include "demos/asset/picture_file.h"

#include <sstream>
#include <utility>

#include "demos/asset/jpeg_picture.h"
#include "engine/foundation/contract.h"
#include "demos/asset/asset_path.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {

/// Two by two pixels become one.
SurfacePicture halved(const SurfacePicture& picture) {
  SurfacePicture half{std::max(1, picture.width / 2), std::max(1, picture.height / 2), {}};
  const auto pixel = [&](int x, int y) {
    return 3 * (static_cast<std::size_t>(std::min(y, picture.height - 1)) *
                    static_cast<std::size_t>(picture.width) +
                static_cast<std::size_t>(std::min(x, picture.width - 1)));
  };
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const int sum = picture.rgb[pixel(2 * x, 2 * y) + c] + picture.rgb[pixel(2 * x + 1, 2 * y) + c] +
                        picture.rgb[pixel(2 * x, 2 * y + 1) + c] +
                        picture.rgb[pixel(2 * x + 1, 2 * y + 1) + c];
        half.rgb.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
      }
  return half;
}

SurfacePicture decodedPng(std::span<const std::uint8_t> file, const std::string& name) {
  std::istringstream in(std::string(file.begin(), file.end()));
  renderer::Image image = renderer::decodePng(in, name).image;
  return {image.width, image.height, std::move(image.rgb)};
}

bool begins(std::span<const std::uint8_t> file, std::string_view signature) {
  if (file.size() < signature.size()) return false;
  for (std::size_t i = 0; i < signature.size(); ++i)
    if (file[i] != static_cast<std::uint8_t>(signature[i])) return false;
  return true;
}

}  // namespace

SurfacePicture decodePicture(std::span<const std::uint8_t> file, const std::string& name) {
  SurfacePicture picture;
  if (begins(file, "\x89PNG"))
    picture = decodedPng(file, name);
  else if (begins(file, "\xff\xd8\xff"))
    picture = decodedJpeg(file, name);
  else
    throw InputError(name + ": neither PNG nor JPEG");
  while (std::max(picture.width, picture.height) > kLongestPictureSide) picture = halved(picture);
  return picture;
}

SurfacePicture readPicture(const std::filesystem::path& path) {
  const std::string bytes = readTextFile(path);
  return decodePicture({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                       path.filename().string());
}

}  // namespace carom::demos
