#include "renderer/draw/picture_array.h"

#include <algorithm>
#include <utility>

#include "renderer/mesh/picture_levels.h"

namespace carom::renderer {
namespace {

constexpr GLenum kUnit = GL_TEXTURE4;

}  // namespace

int PictureArray::add(const SurfacePicture& picture) {
  const auto known = std::find(pictures_.begin(), pictures_.end(), picture);
  if (known != pictures_.end()) return static_cast<int>(known - pictures_.begin());
  pictures_.push_back(picture);
  return static_cast<int>(pictures_.size() - 1);
}

void PictureArray::upload(const GlFunctions& gl) {
  if (empty()) return;
  const PictureSize size = layerSize(pictures_);
  std::vector<std::vector<std::uint8_t>> levels;
  std::vector<PictureSize> sizes;
  for (const SurfacePicture& picture : pictures_) {
    const PictureLevels made = pictureLevels(picture, size.width, size.height);
    levels.resize(made.levels.size());
    sizes.resize(made.levels.size());
    for (std::size_t i = 0; i < made.levels.size(); ++i) {
      const SurfacePicture& level = made.levels[i];
      levels[i].insert(levels[i].end(), level.rgb.begin(), level.rgb.end());
      sizes[i] = {level.width, level.height};
    }
  }
  gl.GenTextures(1, &texture_);
  bind(gl);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t i = 0; i < levels.size(); ++i)
    gl.TexImage3D(GL_TEXTURE_2D_ARRAY, static_cast<GLint>(i), GL_SRGB8, sizes[i].width, sizes[i].height,
                  static_cast<GLsizei>(pictures_.size()), 0, GL_RGB, GL_UNSIGNED_BYTE, levels[i].data());
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  for (const auto& [name, value] :
       {std::pair{GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR},
        std::pair{GL_TEXTURE_MAG_FILTER, GL_LINEAR}, std::pair{GL_TEXTURE_WRAP_S, GL_REPEAT},
        std::pair{GL_TEXTURE_WRAP_T, GL_REPEAT}})
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, static_cast<GLenum>(name), value);
  gl.ActiveTexture(GL_TEXTURE0);
  for (SurfacePicture& picture : pictures_) picture.rgb = {};  // GL has them now.
}

void PictureArray::bind(const GlFunctions& gl) const {
  if (texture_ == 0) return;
  gl.ActiveTexture(kUnit);
  gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture_);
}

}  // namespace carom::renderer
