#include "renderer/draw/frame_block.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom::renderer {
namespace {

constexpr double kShadowLift = 2.2;  // Texels along a grazed surface's normal: the reach of the softening.
constexpr double kFogOverDistance = 6.0;  // Of the distance from eye to target: where the air takes 63 %.
constexpr double kHorizonOverDistance =
    2000.0;                              // Of the same distance: where the ground ends, long since all air.
constexpr double kPatternPeriod = 64.0;  // Squares; ground_pattern.glsl counts its cells from there.
constexpr float kNoGround = -1e30f;

// Squares of 1 m as long as the camera is at a distance where they help.
double checkerSquare(double distance_m) {
  constexpr double kSmallest = 2.5, kLargest = 100.0;  // Camera distances between which a square is 1 m.
  double square = 1.0;
  while (distance_m < kSmallest * square && square > 1e-6) square *= 0.1;
  while (distance_m > kLargest * square && square < 1e6) square *= 10.0;
  return square;
}

// Moves the image by `shift_px`, right and up.
std::array<float, 16> shifted(std::array<float, 16> clip_from_E, const Vec2& shift_px, int width,
                              int height) {
  if (shift_px.isZero(0.0)) return clip_from_E;
  const double x = 2.0 * shift_px.x() / width, y = 2.0 * shift_px.y() / height;
  for (std::size_t column = 0; column < 4; ++column) {
    const float w = clip_from_E[4 * column + 3];
    clip_from_E[4 * column] += static_cast<float>(x) * w;
    clip_from_E[4 * column + 1] += static_cast<float>(y) * w;
  }
  return clip_from_E;
}

void copy(float (&to)[4], const Vec3& v, double w) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(v[i]);
  to[3] = static_cast<float>(w);
}

}  // namespace

double horizonDistance(const Camera& camera) {
  return kHorizonOverDistance * (camera.target - camera.eye).norm();
}

FrameBlock frameBlock(const FrameView& view) {
  const auto& [camera, width, height, depth, shadow, shadow_texels, sample, ground_z_E, ground_color, pool] =
      view;
  const CameraAxes axes = cameraAxes(camera);
  const double focal = focalLengthPixels(camera, height);
  const double distance = (camera.target - camera.eye).norm();
  const double square = checkerSquare(distance);
  FrameBlock block{};
  const std::array<float, 16> clip =
      shifted(clipFromE(camera, width, height, depth), sample.shift_px, width, height);
  std::copy(clip.begin(), clip.end(), block.clip_from_E);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) block.shadow_rows[r][c] = static_cast<float>(shadow.rows(r, c));
  if (shadow.texel_m == 0.0) block.shadow_rows[0][3] = -1.0f;  // Outside the map everywhere: all is lit.
  copy(block.to_light, sample.to_light, kShadowLift * shadow.texel_m);
  const Vec3 x = axes.right / focal, y = axes.up / focal;
  copy(block.ray_corner,
       axes.forward - (0.5 * width + sample.shift_px.x()) * x - (0.5 * height + sample.shift_px.y()) * y,
       1.0 / (kFogOverDistance * distance));
  copy(block.ray_x, x, shadow_texels);
  copy(block.ray_y, y, 0.0);
  block.ground[0] = ground_z_E ? static_cast<float>(*ground_z_E) : kNoGround;
  block.ground[1] = static_cast<float>(1.0 / square);
  block.ground[2] = static_cast<float>(std::fmod(camera.eye.x() / square, 2.0));
  block.ground[3] = static_cast<float>(std::fmod(camera.eye.y() / square, 2.0));
  for (int i = 0; i < 2; ++i) block.mirror[i] = static_cast<float>(sample.mirror_shear[i]);
  block.mirror[2] = 1.0f / static_cast<float>(width);
  block.mirror[3] = 1.0f / static_cast<float>(height);
  for (int i = 0; i < 2; ++i) {
    const double squares = camera.eye[i] / square, before = std::floor(squares / kPatternPeriod);
    block.origin[i] = static_cast<float>(squares - kPatternPeriod * before);
    block.origin[i + 2] = static_cast<float>(before);
  }
  copy(block.ground_color,
       Vec3(linearLight(ground_color.r), linearLight(ground_color.g), linearLight(ground_color.b)), 0.0);
  const Vec3 middle = camera.target - camera.eye;
  copy(block.pool, {middle.x(), middle.y(), pool > 0.0 ? 1.0 / (pool * distance) : 0.0}, 0.0);
  block.reach[0] = static_cast<float>(horizonDistance(camera) / (1 << (4 * kGroundRings)));
  return block;
}

}  // namespace carom::renderer
