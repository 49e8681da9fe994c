#include "renderer/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "engine/foundation/contract.h"
#include "renderer/backdrop.h"
#include "renderer/contact_occlusion.h"
#include "renderer/draw_list.h"
#include "renderer/edge_filter.h"
#include "renderer/multiple_exposure.h"
#include "renderer/scene_geometry.h"
#include "renderer/shader_program.h"
#include "renderer/shaders.h"
#include "renderer/shadow_cells.h"
#include "renderer/shadow_fit.h"
#include "renderer/surface_pass.h"
#include "renderer/water_pass.h"

namespace carom::renderer {
namespace {

constexpr double kShadowLift = 2.2;  // Texels along a grazed surface's normal: the reach of the softening.
constexpr double kFogOverDistance = 6.0;  // Of the distance from eye to target: where the air takes 63 %.
constexpr double kHorizonOverDistance =
    2000.0;  // Of the same distance: where the ground ends, long since all air.
constexpr double kShadowsOverHorizon = 0.5;  // How far off the ground shows shadows.
constexpr float kNoGround = -1e30f;

Settings checked(const Settings& settings) {
  const auto fits = [](int side) { return side >= 1 && side <= kMaxImageSide; };
  if (!fits(settings.width) || !fits(settings.height)) {
    std::ostringstream message;
    message << "image size " << settings.width << "x" << settings.height << " is not within 1x1 and "
            << kMaxImageSide << "x" << kMaxImageSide;
    throw InputError(message.str());
  }
  if (!settings.to_light.allFinite() || !(settings.to_light.norm() > 0.0))
    throw InputError("the direction to the light must be finite and not zero");
  return settings;
}

// Squares of 1 m as long as the camera is at a distance where they help.
double checkerSquare(double distance_m) {
  constexpr double kSmallest = 2.5, kLargest = 100.0;  // Camera distances between which a square is 1 m.
  double square = 1.0;
  while (distance_m < kSmallest * square && square > 1e-6) square *= 0.1;
  while (distance_m > kLargest * square && square < 1e6) square *= 10.0;
  return square;
}

// Moves the image by `shift_px`, right and up.
std::array<float, 16> shifted(std::array<float, 16> clip_from_E, const Vec2& shift_px,
                              const Settings& settings) {
  if (shift_px.isZero(0.0)) return clip_from_E;
  const double x = 2.0 * shift_px.x() / settings.width, y = 2.0 * shift_px.y() / settings.height;
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

struct FrameRenderer::Impl {
  Impl(const Settings& wanted, std::span<const Solid> given)
      : settings(checked(wanted)),
        quality(qualityOf(settings.preset, settings.style)),
        samples(samplesOf(quality, settings.to_light.normalized())),
        solids(given.begin(), given.end()),
        context(createOffscreenContext(settings.pixels, settings.backend, settings.gl_threads)),
        gl(context->gl()),
        geometry(gl, solids),
        filter(settings.width, settings.height),
        surface_pass(gl, {settings.width, settings.height}) {
    linkPrograms();
    createTargets();
    if (quality.mirror) createMirrorTarget();
    createOcclusionBuffer();
    gl.GenBuffers(1, &frame_buffer);
    gl.GenVertexArrays(1, &no_attributes);
    pixels.resize(4 * static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height));
  }

  std::string shaderVariant() const;
  void linkPrograms();
  GLuint linkBodies(const char* name, const std::string& lines) const;
  GLuint bodyProgram(BodyShader shader);
  void createTargets();
  void createMirrorTarget();
  void createOcclusionBuffer();
  const Image& draw(std::span<const Instance> instances, const Camera& camera,
                    const std::function<void()>& drawn, std::span<const WaterVolume> water);
  void expose(const Sample& sample);
  ShadowCells castShadows(const Vec3& to_light);
  FrameBlock uploadFrame(const ShadowView& shadow, const Sample& sample) const;
  void drawShadows() const;
  void drawMirrored() const;
  void drawScene(const FrameBlock& block, const ShadowCells& shadows);
  void bindTextures() const;
  std::vector<OcclusionVertex> occlusionTriangles() const;
  void drawOcclusion() const;
  void readBack();
  const SurfaceImage& knownSurfaces();

  // What the frame at hand shows.
  struct View {
    std::vector<Instance> instances;
    Camera camera;
    std::optional<int> ground;
    ShadowView shadow;
    DrawList list;
    std::vector<OcclusionVertex> occlusion;
    std::vector<WaterVolume> water;
  };

  Settings settings;
  Quality quality;
  std::vector<Sample> samples;
  std::vector<Solid> solids;
  std::unique_ptr<OffscreenContext> context;
  const GlFunctions& gl;
  SceneGeometry geometry;
  EdgeFilter filter;
  MultipleExposure exposure;
  SurfacePass surface_pass;
  std::unique_ptr<WaterPass> water_pass;
  std::unique_ptr<Backdrop> backdrop;
  std::array<GLuint, kBodyShaders> body_programs{};  // Linked when first needed.
  GLuint shadow_program = 0, occlusion_program = 0, mirrored_program = 0;
  GLuint scene_target = 0, shadow_target = 0, mirror_target = 0, shadow_map = 0, mirror_texture = 0;
  int mirror_width = 0, mirror_height = 0;
  GLuint frame_buffer = 0, no_attributes = 0, occlusion_array = 0, occlusion_buffer = 0;
  std::vector<std::uint8_t> pixels;
  Image image;
  View view;
  SurfaceImage surfaces;
  bool surfaces_known = true;  // Those of a view that shows nothing yet: none.
};

std::string FrameRenderer::Impl::shaderVariant() const {
  std::string variant;
  if (settings.style == Style::kPrint) variant += "#define PRINT\n";
  if (!quality.soft_look_up) variant += "#define SMALL_SHADOWS\n";
  if (quality.mirror) variant += "#define POLISHED\n";
  return variant;
}

void FrameRenderer::Impl::linkPrograms() {
  shadow_program = linkProgram(gl, {"shadow", {kGlslHead, kShadowVertex}, {kGlslHead, kShadowFragment}});
  occlusion_program =
      linkProgram(gl, {"occlusion", {kGlslHead, kOcclusionVertex}, {kGlslHead, kOcclusionFragment}});
  if (quality.mirror) mirrored_program = linkBodies("mirrored body", "#define MIRROR\n#define CHECKER\n");
}

GLuint FrameRenderer::Impl::linkBodies(const char* name, const std::string& lines) const {
  const std::string variant = shaderVariant() + lines;
  return linkProgram(gl, {name,
                          {kGlslHead, variant.c_str(), kBodyVertex},
                          {kGlslHead, variant.c_str(), kGlslLight, kBodyFragment}});
}

GLuint FrameRenderer::Impl::bodyProgram(BodyShader shader) {
  static constexpr std::array<const char*, kBodyShaders> lines = {"#define SUNLIT\n", "",
                                                                  "#define CHECKER\n"};
  const auto i = static_cast<std::size_t>(shader);
  if (body_programs[i] == 0) body_programs[i] = linkBodies("body", lines[i]);
  return body_programs[i];
}

void FrameRenderer::Impl::createTargets() {
  GLuint color = 0, depth = 0;
  gl.GenRenderbuffers(1, &color);
  gl.BindRenderbuffer(GL_RENDERBUFFER, color);
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, settings.width, settings.height);
  gl.GenTextures(1, &depth);
  gl.BindTexture(GL_TEXTURE_2D, depth);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, settings.width, settings.height, 0,
                GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.GenFramebuffers(1, &scene_target);
  gl.BindFramebuffer(GL_FRAMEBUFFER, scene_target);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
  const bool scene_complete = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  water_pass = std::make_unique<WaterPass>(
      gl, WaterPass::Scene{color, depth, settings.width, settings.height}, shaderVariant());
  backdrop = std::make_unique<Backdrop>(
      gl, Backdrop::Request{settings.width, settings.height, shaderVariant(), quality.mirror});

  gl.GenTextures(1, &shadow_map);
  gl.BindTexture(GL_TEXTURE_2D, shadow_map);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, quality.shadow_texels, quality.shadow_texels, 0,
                GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  gl.GenFramebuffers(1, &shadow_target);
  gl.BindFramebuffer(GL_FRAMEBUFFER, shadow_target);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_map, 0);
  gl.DrawBuffer(GL_NONE);
  const bool shadow_complete = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  if (!scene_complete || !shadow_complete || gl.GetError() != GL_NO_ERROR) {
    std::ostringstream message;
    message << "the GL driver has no room for an image of " << settings.width << "x" << settings.height;
    throw NoRenderer(message.str());
  }
}

void FrameRenderer::Impl::createOcclusionBuffer() {
  gl.GenBuffers(1, &occlusion_buffer);
  gl.GenVertexArrays(1, &occlusion_array);
  gl.BindVertexArray(occlusion_array);
  gl.BindBuffer(GL_ARRAY_BUFFER, occlusion_buffer);
  constexpr std::size_t kTriple = 3 * sizeof(float);  // Attributes are three floats each.
  static_assert(sizeof(OcclusionVertex) == 5 * kTriple);
  for (GLuint i = 0; i < 5; ++i) {
    gl.VertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(OcclusionVertex),
                           reinterpret_cast<const void*>(kTriple * i));
    gl.EnableVertexAttribArray(i);
  }
}

// What the ground mirrors: bodies where alpha is one. Half as fine as the image: the exposures blur it
// anyway.
void FrameRenderer::Impl::createMirrorTarget() {
  GLuint depth = 0;
  mirror_width = (settings.width + 1) / 2;
  mirror_height = (settings.height + 1) / 2;
  gl.GenTextures(1, &mirror_texture);
  gl.BindTexture(GL_TEXTURE_2D, mirror_texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, mirror_width, mirror_height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.GenRenderbuffers(1, &depth);
  gl.BindRenderbuffer(GL_RENDERBUFFER, depth);
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, mirror_width, mirror_height);
  gl.GenFramebuffers(1, &mirror_target);
  gl.BindFramebuffer(GL_FRAMEBUFFER, mirror_target);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, mirror_texture, 0);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || gl.GetError() != GL_NO_ERROR) {
    std::ostringstream message;
    message << "the GL driver has no room for mirrored images of " << settings.width << "x"
            << settings.height;
    throw NoRenderer(message.str());
  }
}

// One exposure or several, and their mean.
const Image& FrameRenderer::Impl::draw(std::span<const Instance> instances, const Camera& camera,
                                       const std::function<void()>& drawn,
                                       std::span<const WaterVolume> water) {
  for (const Instance& instance : instances)
    REQUIRE(instance.solid >= 0 && instance.solid < geometry.solidCount(), instance.solid,
            geometry.solidCount());
  view.instances.assign(instances.begin(), instances.end());
  view.camera = camera;
  view.ground = findGround(instances, geometry);
  view.occlusion = occlusionTriangles();
  view.water.assign(water.begin(), water.end());
  surfaces_known = false;
  context->makeCurrent();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    expose(samples[i]);
    if (drawn && i + 1 == samples.size()) {
      gl.Finish();
      drawn();
    }
    readBack();
    if (samples.size() > 1) exposure.add(image);
  }
  if (samples.size() > 1) exposure.develop(image);
  return image;
}

// The passes: shadow map, mirrored bodies, sky and ground, bodies, the ground's shadows, contact shadows,
// water.
void FrameRenderer::Impl::expose(const Sample& sample) {
  const ShadowCells shadows = castShadows(sample.to_light);
  const FrameBlock block = uploadFrame(view.shadow, sample);
  geometry.uploadInstances(gl, view.list.records);
  drawShadows();
  if (quality.mirror) drawMirrored();
  drawScene(block, shadows);
  drawOcclusion();
  water_pass->draw(view.water, view.camera, view.list.depth);
}

// Decides what the shadow map shows, and with it which bodies are drawn how.
ShadowCells FrameRenderer::Impl::castShadows(const Vec3& to_light) {
  const Camera& camera = view.camera;
  std::vector<ShadowCaster> casters;
  std::vector<ShadedBody> bodies;
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    if (view.ground == static_cast<int>(i)) continue;
    const Instance& instance = view.instances[i];
    const Extent& extent = geometry.solid(instance.solid).extent;
    casters.push_back({{instance.X_WB.rotation, instance.X_WB * extent.center - camera.eye}, extent.half});
    bodies.push_back({&solids[static_cast<std::size_t>(instance.solid)],
                      {instance.X_WB.rotation, instance.X_WB.position - camera.eye},
                      casters.back()});
  }
  view.shadow = fitShadow(
      {camera, static_cast<double>(settings.width) / settings.height, to_light, quality.shadow_texels},
      casters);
  std::vector<FaceLight> lights = faceLights(view.shadow, to_light, bodies);
  if (view.ground) lights.insert(lights.begin() + *view.ground, FaceLight{});
  view.list = buildDrawList(view.instances, camera, settings, geometry, lights);
  return {view.shadow, casters};
}

FrameBlock FrameRenderer::Impl::uploadFrame(const ShadowView& shadow, const Sample& sample) const {
  const Camera& camera = view.camera;
  const DrawList& list = view.list;
  const CameraAxes axes = cameraAxes(camera);
  const double focal = focalLengthPixels(camera, settings.height);
  const double distance = (camera.target - camera.eye).norm();
  const double square = checkerSquare(distance);
  FrameBlock block{};
  const std::array<float, 16> clip =
      shifted(clipFromE(camera, settings.width, settings.height, list.depth), sample.shift_px, settings);
  std::copy(clip.begin(), clip.end(), block.clip_from_E);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) block.shadow_rows[r][c] = static_cast<float>(shadow.rows(r, c));
  if (shadow.texel_m == 0.0) block.shadow_rows[0][3] = -1.0f;  // Outside the map everywhere: all is lit.
  copy(block.to_light, sample.to_light, kShadowLift * shadow.texel_m);
  const Vec3 x = axes.right / focal, y = axes.up / focal;
  copy(block.ray_corner,
       axes.forward - (0.5 * settings.width + sample.shift_px.x()) * x -
           (0.5 * settings.height + sample.shift_px.y()) * y,
       1.0 / (kFogOverDistance * distance));
  copy(block.ray_x, x, quality.shadow_texels);
  copy(block.ray_y, y, 0.0);
  block.ground[0] = list.ground ? static_cast<float>(list.ground_z_E) : kNoGround;
  block.ground[1] = static_cast<float>(1.0 / square);
  block.ground[2] = static_cast<float>(std::fmod(camera.eye.x() / square, 2.0));
  block.ground[3] = static_cast<float>(std::fmod(camera.eye.y() / square, 2.0));
  for (int i = 0; i < 2; ++i) block.mirror[i] = static_cast<float>(sample.mirror_shear[i]);
  block.mirror[2] = 1.0f / static_cast<float>(settings.width);
  block.mirror[3] = 1.0f / static_cast<float>(settings.height);
  block.reach[0] = static_cast<float>(kHorizonOverDistance * distance / (1 << (4 * kGroundRings)));
  gl.BindBuffer(GL_UNIFORM_BUFFER, frame_buffer);
  gl.BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_buffer);
  return block;
}

void FrameRenderer::Impl::drawShadows() const {
  if (view.shadow.texel_m == 0.0) return;
  gl.BindFramebuffer(GL_FRAMEBUFFER, shadow_target);
  gl.Viewport(0, 0, quality.shadow_texels, quality.shadow_texels);
  gl.Enable(GL_DEPTH_TEST);
  gl.Disable(GL_BLEND);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LESS);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  gl.Enable(GL_CULL_FACE);
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(1.5f, 4.0f);
  gl.UseProgram(shadow_program);
  for (const DrawGroup& group : view.list.casting) geometry.draw(gl, group.range, group.first, group.count);
  gl.Disable(GL_POLYGON_OFFSET_FILL);
}

// The winding turns over in a mirror.
void FrameRenderer::Impl::drawMirrored() const {
  gl.BindFramebuffer(GL_FRAMEBUFFER, mirror_target);
  gl.Viewport(0, 0, mirror_width, mirror_height);
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  gl.Enable(GL_DEPTH_TEST);
  gl.Disable(GL_BLEND);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LEQUAL);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  bindTextures();
  if (!view.list.ground || !(view.list.ground_z_E < 0.0)) return;
  gl.Enable(GL_CULL_FACE);
  gl.FrontFace(GL_CW);
  gl.UseProgram(mirrored_program);
  for (const DrawGroup& group : view.list.mirrored) geometry.draw(gl, group.range, group.first, group.count);
  gl.FrontFace(GL_CCW);
}

void FrameRenderer::Impl::bindTextures() const {
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, mirror_texture);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, shadow_map);
}

void FrameRenderer::Impl::drawScene(const FrameBlock& block, const ShadowCells& shadows) {
  const DrawList& list = view.list;
  const bool ground_seen = list.ground && list.ground_z_E < 0.0;
  bindTextures();
  backdrop->copyTo(scene_target, block, ground_seen);
  gl.Viewport(0, 0, settings.width, settings.height);
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  gl.Enable(GL_DEPTH_TEST);
  gl.Disable(GL_BLEND);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LEQUAL);
  gl.Enable(GL_CULL_FACE);
  for (const DrawGroup& group : list.visible) {
    gl.UseProgram(bodyProgram(group.shader));
    geometry.draw(gl, group.range, group.first, group.count);
  }
  gl.Disable(GL_CULL_FACE);
  gl.DepthMask(GL_FALSE);
  if (ground_seen && block.to_light[2] > 0.0f) {
    const double horizon_m = kHorizonOverDistance * (view.camera.target - view.camera.eye).norm();
    backdrop->drawShadows(shadows.groundTriangles(list.ground_z_E, kShadowsOverHorizon * horizon_m));
  }
}

std::vector<OcclusionVertex> FrameRenderer::Impl::occlusionTriangles() const {
  std::vector<OcclusionBody> bodies;
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    const Instance& instance = view.instances[i];
    const Solid& solid = solids[static_cast<std::size_t>(instance.solid)];
    const Pose X_EB{instance.X_WB.rotation, instance.X_WB.position - view.camera.eye};
    bodies.push_back({&solid, geometry.solid(instance.solid).boxes, X_EB, solid.radius(),
                      view.ground == static_cast<int>(i)});
  }
  return contactOcclusion(bodies, focalLengthPixels(view.camera, settings.height));
}

void FrameRenderer::Impl::drawOcclusion() const {
  const std::vector<OcclusionVertex>& triangles = view.occlusion;
  if (triangles.empty()) return;
  gl.BindVertexArray(occlusion_array);
  gl.BindBuffer(GL_ARRAY_BUFFER, occlusion_buffer);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(OcclusionVertex)),
                triangles.data(), GL_STREAM_DRAW);
  gl.Disable(GL_FRAMEBUFFER_SRGB);  // Blending bytes is cheap; the shader accounts for their meaning.
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_ZERO, GL_SRC_COLOR);
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(-1.0f, -8.0f);
  gl.UseProgram(occlusion_program);
  gl.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.size()));
  gl.Disable(GL_POLYGON_OFFSET_FILL);
  gl.Disable(GL_BLEND);
  gl.Enable(GL_FRAMEBUFFER_SRGB);
}

void FrameRenderer::Impl::readBack() {
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.ReadPixels(0, 0, settings.width, settings.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  filter.apply(pixels, image);
}

const SurfaceImage& FrameRenderer::Impl::knownSurfaces() {
  if (surfaces_known) return surfaces;
  context->makeCurrent();
  uploadFrame({}, {});
  surface_pass.draw(view.instances, solids, view.camera, view.list, geometry, surfaces);
  surfaces_known = true;
  return surfaces;
}

FrameRenderer::FrameRenderer(const Settings& settings, std::span<const Solid> solids)
    : impl_(std::make_unique<Impl>(settings, solids)) {}
FrameRenderer::~FrameRenderer() = default;

const Image& FrameRenderer::draw(std::span<const Instance> instances, const Camera& camera,
                                 const std::function<void()>& drawn, std::span<const WaterVolume> water) {
  return impl_->draw(instances, camera, drawn, water);
}
const SurfaceImage& FrameRenderer::surfaces() {
  return impl_->knownSurfaces();
}
ContextInfo FrameRenderer::info() const {
  return impl_->context->info();
}

}  // namespace carom::renderer
