#include "renderer/passes/surface_pass.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <tuple>

#include "engine/foundation/contract.h"
#include "renderer/draw/shaders.h"
#include "renderer/gl/offscreen_context.h"
#include "renderer/gl/shader_program.h"
#include "renderer/passes/round_surfaces.h"

namespace carom::renderer {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

}  // namespace

void SurfacePass::createTargets() {
  if (target_ != 0) return;
  program_ = linkProgram(gl_, sourcesOf(Shader::kSurfaces));
  GLuint buffers[3];
  gl_.GenRenderbuffers(3, buffers);
  gl_.GenFramebuffers(1, &target_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  const std::tuple<GLenum, GLenum> kinds[] = {{GL_RGBA32F, GL_COLOR_ATTACHMENT0},
                                              {GL_R32F, GL_COLOR_ATTACHMENT1},
                                              {GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [format, attachment] = kinds[i];
    gl_.BindRenderbuffer(GL_RENDERBUFFER, buffers[i]);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, format, size_.width, size_.height);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffers[i]);
  }
  const GLenum drawn[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl_.DrawBuffers(2, drawn);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    std::ostringstream message;
    message << "the GL driver has no room for depths and normals of " << size_.width << "x" << size_.height;
    throw NoRenderer(message.str());
  }
  const std::size_t pixels = static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height);
  normals_and_depths_.resize(4 * pixels);
  ids_.resize(pixels);
}

void SurfacePass::drawFlatParts(std::span<const Instance> instances, const Camera& camera,
                                const SceneGeometry& geometry, int ground) {
  std::vector<int> order;
  for (int i = 0; i < static_cast<int>(instances.size()); ++i)
    if (i != ground) order.push_back(i);
  const auto solidOf = [&](int i) { return instances[static_cast<std::size_t>(i)].solid; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return solidOf(a) < solidOf(b); });
  std::vector<InstanceRecord> records;
  for (const int i : order) {
    records.push_back(
        instanceRecord(instances[static_cast<std::size_t>(i)], geometry.solid(solidOf(i)), camera));
    records.back().color[0] = static_cast<float>(i + 1);
  }
  geometry.uploadInstances(gl_, records);

  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  gl_.Viewport(0, 0, size_.width, size_.height);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Enable(GL_CULL_FACE);
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.UseProgram(program_);
  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    while (end < order.size() && solidOf(order[end]) == solidOf(order[i])) ++end;
    const MeshRange& range = geometry.solid(solidOf(order[i])).flat_parts;
    if (range.count > 0) geometry.draw(gl_, range, static_cast<int>(i), static_cast<int>(end - i));
  }
}

// Sky, and below the horizon the ground where there is one in view.
void SurfacePass::startWithGround(const Camera& camera, const DrawList& list, SurfaceImage& surfaces) const {
  const std::size_t pixels = static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height);
  surfaces.depth.width = size_.width;
  surfaces.depth.height = size_.height;
  surfaces.depth.depth_m.assign(pixels, kFar);
  surfaces.normal_W.assign(pixels, {0.0f, 0.0f, 0.0f});
  surfaces.instance.assign(pixels, kSky);
  if (!list.ground || !(list.ground_z_E < 0.0)) return;
  const CameraAxes axes = cameraAxes(camera);
  const double focal = focalLengthPixels(camera, size_.height);
  std::size_t pixel = 0;
  for (int y = 0; y < size_.height; ++y)
    for (int x = 0; x < size_.width; ++x, ++pixel) {
      // The ray's descent per metre of depth; `right` is level.
      const double rise = axes.forward.z() + (x + 0.5 - 0.5 * size_.width) / focal * axes.right.z() -
                          (y + 0.5 - 0.5 * size_.height) / focal * axes.up.z();
      if (!(rise < 0.0)) continue;
      surfaces.depth.depth_m[pixel] = static_cast<float>(list.ground_z_E / rise);
      surfaces.normal_W[pixel] = {0.0f, 0.0f, 1.0f};
      surfaces.instance[pixel] = *list.ground;
    }
}

void SurfacePass::takeFlatParts(SurfaceImage& surfaces) {
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl_.ReadPixels(0, 0, size_.width, size_.height, GL_RED, GL_FLOAT, ids_.data());
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_FLOAT, normals_and_depths_.data());
  const std::size_t width = static_cast<std::size_t>(size_.width);
  for (int y = 0; y < size_.height; ++y) {
    const std::size_t from = static_cast<std::size_t>(size_.height - 1 - y) * width;
    const std::size_t to = static_cast<std::size_t>(y) * width;
    for (std::size_t x = 0; x < width; ++x) {
      const float id = ids_[from + x];
      const float* sample = normals_and_depths_.data() + 4 * (from + x);
      if (id == 0.0f || !(sample[3] < surfaces.depth.depth_m[to + x])) continue;
      surfaces.depth.depth_m[to + x] = sample[3];
      surfaces.normal_W[to + x] = {sample[0], sample[1], sample[2]};
      surfaces.instance[to + x] = static_cast<std::int32_t>(id) - 1;
    }
  }
}

void SurfacePass::draw(std::span<const Instance> instances, std::span<const Solid> solids,
                       const Camera& camera, const DrawList& list, const SceneGeometry& geometry,
                       SurfaceImage& surfaces) {
  createTargets();
  const int ground = list.ground ? *list.ground : -1;
  drawFlatParts(instances, camera, geometry, ground);
  startWithGround(camera, list, surfaces);
  takeFlatParts(surfaces);
  const GLenum error = gl_.GetError();
  REQUIRE(error == GL_NO_ERROR, error);  // What GL refuses to draw is missing without a word otherwise.
  addRoundSurfaces(instances, solids, camera, ground, surfaces);
}

}  // namespace carom::renderer
