#include "renderer/passes/water_pass.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "renderer/draw/shaders.h"
#include "renderer/gl/offscreen_context.h"
#include "renderer/gl/shader_program.h"

namespace carom::renderer {
namespace {

static_assert(kWaterWavesInBlock == kMostWaves);
constexpr double kEndless_m = 1e9;           // Stands for sides at infinity.
constexpr float kDarkest = 0.004f;           // Light of a colour's channel: less would absorb without bounds.
constexpr double kScatteredOverColor = 0.6;  // Light of water without end over that of its colour.
constexpr double kFoamLine_px = 0.9;         // Half its width in small images; it grows with the height.
constexpr double kFoamLineOverHeight = 1.0 / 480.0;
constexpr int kMargin_px = 4;  // Around a box on the image, for the foam line.

Vec3 bounded(const Vec3& v) {
  return v.cwiseMax(-kEndless_m).cwiseMin(kEndless_m);
}

void copy(float (&to)[4], const Vec3& v, double w) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(v[i]);
  to[3] = static_cast<float>(w);
}

// The highest waves, in their order.
std::vector<WaterWave> drawnWaves(const WaterVolume& volume) {
  std::vector<WaterWave> waves;
  for (const WaterWave& wave : volume.waves)
    if (wave.amplitude_m != 0.0) waves.push_back(wave);
  std::stable_sort(waves.begin(), waves.end(), [](const WaterWave& a, const WaterWave& b) {
    return std::abs(a.amplitude_m) > std::abs(b.amplitude_m);
  });
  if (waves.size() > kMostWaves) waves.resize(kMostWaves);
  return waves;
}

WaterBlock blockOf(const WaterVolume& volume, const Vec3& eye, const DepthRange& depth, int height_px) {
  WaterBlock block{};
  const std::vector<WaterWave> waves = drawnWaves(volume);
  double reach = 0.0, slope = 0.0;
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const WaterWave& wave = waves[i];
    reach += std::abs(wave.amplitude_m);
    slope += std::abs(wave.amplitude_m) * wave.wave_vector.norm();
    // The phase over the eye, in double precision: far from the world's origin it is a large number.
    const double phase =
        std::remainder(wave.wave_vector.dot(eye.head<2>()) + wave.phase, 2.0 * std::numbers::pi);
    copy(block.waves[i], {wave.amplitude_m, wave.wave_vector.x(), wave.wave_vector.y()}, phase);
  }
  const Vec3 light(linearLight(volume.color.r), linearLight(volume.color.g), linearLight(volume.color.b));
  Vec3 absorption;
  for (int i = 0; i < 3; ++i) absorption[i] = -std::log(std::clamp<double>(light[i], kDarkest, 1.0));
  copy(block.low, bounded(volume.min - eye), static_cast<double>(waves.size()));
  copy(block.high, bounded(volume.max - eye), reach);
  copy(block.absorption, absorption / kColorDepth_m, slope);
  copy(block.scattered, kScatteredOverColor * light, std::max(kFoamLine_px, kFoamLineOverHeight * height_px));
  block.depth[0] = static_cast<float>(depth.near_m);
  block.depth[1] = static_cast<float>(depth.far_m);
  return block;
}

double distanceTo(const WaterVolume& volume, const Vec3& p) {
  return (p - p.cwiseMax(volume.min).cwiseMin(volume.max)).norm();
}

}  // namespace

void WaterPass::create() {
  program_ = linkProgram(gl_, sourcesOf(Shader::kWater, variant_));
  gl_.GenVertexArrays(1, &no_attributes_);
  gl_.GenBuffers(1, &block_buffer_);
  gl_.GenFramebuffers(1, &target_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, scene_.color_buffer);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    std::ostringstream message;
    message << "the GL driver cannot draw water over an image of " << scene_.width << "x" << scene_.height;
    throw NoRenderer(message.str());
  }
}

// Spares the pixels where a box cannot be, if all of it lies ahead of the eye.
void WaterPass::limitTo(const WaterVolume& volume, const Camera& camera) const {
  Eigen::AlignedBox2d seen;
  bool ahead = volume.min.allFinite() && volume.max.allFinite();
  double reach = 0.0;
  for (const WaterWave& wave : volume.waves) reach += std::abs(wave.amplitude_m);
  for (int corner = 0; ahead && corner < 8; ++corner) {
    const Vec3 p((corner & 1) != 0 ? volume.max.x() : volume.min.x(),
                 (corner & 2) != 0 ? volume.max.y() : volume.min.y(),
                 (corner & 4) != 0 ? volume.max.z() + reach : volume.min.z());
    const std::optional<Vec2> pixel = projectToPixel(camera, scene_.width, scene_.height, p);
    ahead = pixel.has_value();
    if (ahead) seen.extend(*pixel);
  }
  if (!ahead) return gl_.Scissor(0, 0, scene_.width, scene_.height);
  const auto within = [](double px, int size) {
    return static_cast<int>(std::clamp(px, 0.0, static_cast<double>(size)));
  };
  const int left = within(std::floor(seen.min().x()) - kMargin_px, scene_.width),
            right = within(std::ceil(seen.max().x()) + kMargin_px, scene_.width),
            top = within(std::floor(seen.min().y()) - kMargin_px, scene_.height),
            bottom = within(std::ceil(seen.max().y()) + kMargin_px, scene_.height);
  gl_.Scissor(left, scene_.height - bottom, right - left, bottom - top);
}

void WaterPass::drawVolume(const WaterVolume& volume, const Camera& camera, const DepthRange& depth) const {
  const WaterBlock block = blockOf(volume, camera.eye, depth, scene_.height);
  gl_.BindBuffer(GL_UNIFORM_BUFFER, block_buffer_);
  gl_.BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, 1, block_buffer_);
  limitTo(volume, camera);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void WaterPass::draw(std::span<const WaterVolume> volumes, const Camera& camera, const DepthRange& depth) {
  if (volumes.empty()) return;
  if (program_ == 0) create();
  std::vector<const WaterVolume*> order;
  for (const WaterVolume& volume : volumes) order.push_back(&volume);
  std::stable_sort(order.begin(), order.end(), [&](const WaterVolume* a, const WaterVolume* b) {
    return distanceTo(*a, camera.eye) > distanceTo(*b, camera.eye);
  });
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_ONE, GL_SRC1_COLOR);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.BindVertexArray(no_attributes_);
  gl_.ActiveTexture(GL_TEXTURE2);
  gl_.BindTexture(GL_TEXTURE_2D, scene_.depth_texture);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.UseProgram(program_);
  for (const WaterVolume* volume : order) drawVolume(*volume, camera, depth);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_BLEND);
  // A function of a second colour makes any drawing to two targets an error, even while blending is off.
  gl_.BlendFunc(GL_ONE, GL_ZERO);
}

}  // namespace carom::renderer
