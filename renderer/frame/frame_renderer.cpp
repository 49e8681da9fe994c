#include "renderer/frame/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "engine/foundation/contract.h"
#include "renderer/draw/body_programs.h"
#include "renderer/draw/draw_list.h"
#include "renderer/draw/frame_block.h"
#include "renderer/draw/scene_geometry.h"
#include "renderer/draw/shader_lines.h"
#include "renderer/draw/shaders.h"
#include "renderer/frame/frame_damage.h"
#include "renderer/gl/offscreen_context.h"
#include "renderer/gl/scissor.h"
#include "renderer/gl/shader_program.h"
#include "renderer/image/cutout.h"
#include "renderer/image/edge_filter.h"
#include "renderer/mesh/contact_occlusion.h"
#include "renderer/passes/backdrop.h"
#include "renderer/passes/glass_pass.h"
#include "renderer/passes/mirror_pass.h"
#include "renderer/passes/occlusion_pass.h"
#include "renderer/passes/shadow_map.h"
#include "renderer/passes/surface_pass.h"
#include "renderer/passes/water_pass.h"
#include "renderer/view/multiple_exposure.h"
#include "renderer/view/shadow_cells.h"
#include "renderer/view/shadow_fit.h"

namespace carom::renderer {
namespace {

constexpr double kShadowsOverHorizon = 0.5;  // How far off the ground shows shadows.

Settings checked(const Settings& settings) {
  const auto fits = [](int side) { return side >= 1 && side <= kMaxImageSide; };
  if (!fits(settings.width) || !fits(settings.height)) {
    std::ostringstream message;
    message << "image size " << settings.width << "x" << settings.height << " is not within 1x1 and "
            << kMaxImageSide << "x" << kMaxImageSide;
    throw InputError(message.str());
  }
  const Vec3& to_light = settings.light.to_light;
  if (!to_light.allFinite() || !(to_light.norm() > 0.0))
    throw InputError("the direction to the light must be finite and not zero");
  return settings;
}

// Whether values have the same bits; unlike ==, of zeros and of what is no number too.
template <typename Vector>
bool sameBits(const Vector& a, const Vector& b) {
  return std::memcmp(a.data(), b.data(), sizeof(typename Vector::Scalar) * Vector::SizeAtCompileTime) == 0;
}
bool isSame(const Camera& a, const Camera& b) {
  return sameBits(a.eye, b.eye) && sameBits(a.target, b.target) && a.fov_degrees == b.fov_degrees &&
         a.aperture_m == b.aperture_m && a.focus_m == b.focus_m;
}
bool isSame(const Instance& a, const Instance& b) {
  return a.solid == b.solid && a.checker == b.checker && a.pattern == b.pattern && a.surface == b.surface &&
         std::memcmp(&a.color, &b.color, sizeof(Color)) == 0 &&
         sameBits(a.X_WB.rotation.coeffs(), b.X_WB.rotation.coeffs()) &&
         sameBits(a.X_WB.position, b.X_WB.position);
}

// The bodies of each block in their order, as far as they may be seen in it; `boundsOf` tells where a body
// is. Their records are appended.
template <typename BoundsOf>
std::vector<BlockGroups> groupsWithin(const std::vector<GridBlock>& blocks, std::span<const DrawnBody> bodies,
                                      const BoundsOf& boundsOf, std::vector<InstanceRecord>& records) {
  std::vector<GridBlock> seen;
  for (const DrawnBody& body : bodies) seen.push_back(boundsOf(body));
  std::vector<BlockGroups> within;
  for (const GridBlock& block : blocks) {
    within.push_back({block, {}});
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (seen[i].meets(block)) appendTo(within.back().groups, records, bodies[i]);
  }
  return within;
}

bool isWhole(std::span<const GridBlock> blocks, const Settings& settings) {
  return blocks.size() == 1 && blocks.front() == GridBlock{0, settings.width, 0, settings.height};
}

std::int64_t trianglesOf(std::span<const DrawGroup> groups) {
  std::int64_t triangles = 0;
  for (const DrawGroup& group : groups) triangles += std::int64_t{group.range.count} / 3 * group.count;
  return triangles;
}

}  // namespace

struct FrameRenderer::Impl {
  Impl(const Settings& wanted, std::span<const Solid> given)
      : settings(checked(wanted)),
        quality(qualityOf(settings)),
        samples(samplesOf(quality, settings.light.to_light.normalized())),
        solids(given.begin(), given.end()),
        context(createOffscreenContext(settings.pixels, settings.backend, settings.gl_threads)),
        gl(context->gl()),
        geometry(gl, solids),
        filter(settings.width, settings.height),
        shadow_map(gl, quality.shadow_texels),
        occlusion_pass(gl, frameLines(settings)),
        surface_pass(gl, {settings.width, settings.height}),
        body_programs(gl, settings, !geometry.pictures().empty()) {
    createTargets();
    if (quality.mirror)
      mirror_pass = std::make_unique<MirrorPass>(gl, body_programs, settings.width, settings.height);
    gl.GenBuffers(1, &frame_buffer);
    pixels.resize(4 * static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height));
  }

  void createTargets();
  const Image& draw(std::span<const Instance> instances, const Camera& camera,
                    const std::function<void()>& drawn, std::span<const WaterVolume> water,
                    std::span<const std::vector<Instance>> moments);
  void exposeAll(std::span<const std::vector<Instance>> moments, const std::function<void()>& drawn);
  bool showsAlready(std::span<const Instance> instances, const Camera& camera,
                    std::span<const WaterVolume> water) const;
  void exposeOnce(const Sample& sample, const std::function<void()>& drawn);
  std::vector<GridBlock> expose(const Sample& sample);
  FrameDamage damageBy(const FrameInputs& inputs) const;
  ShadowCells castShadows(const Vec3& to_light);
  FrameInputs inputsOf(const Sample& sample, const ShadowCells& shadows) const;
  FrameBlock blockOf(const Sample& sample, const ShadowView& shadow) const;
  void uploadBlock(const FrameBlock& block) const;
  void drawScene(const FrameInputs& inputs, std::span<const GridBlock> blocks,
                 std::span<const BlockGroups> bodies);
  void bindTextures() const;
  std::vector<OcclusionTriangle> occlusionTriangles() const;
  void drawOcclusion(const FrameInputs& inputs, std::span<const GridBlock> blocks,
                     const ScreenBounds& bounds) const;
  void readBack(std::span<const GridBlock> blocks);
  void count(std::span<const GridBlock> blocks, std::span<const BlockGroups> bodies, std::int64_t& area);
  const SurfaceImage& knownSurfaces();

  // What the frame at hand shows.
  struct View {
    std::vector<Instance> instances;
    Camera camera;
    std::optional<int> ground;
    ShadowView shadow;
    DrawList list;
    std::vector<OcclusionTriangle> occlusion;
    std::vector<WaterVolume> water;
    FrameInputs inputs;  // Of the exposure at hand.
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
  ShadowMap shadow_map;
  OcclusionPass occlusion_pass;
  SurfacePass surface_pass;
  BodyPrograms body_programs;
  std::unique_ptr<MirrorPass> mirror_pass;  // Where the ground mirrors.
  std::unique_ptr<GlassPass> glass_pass;
  std::unique_ptr<WaterPass> water_pass;
  std::unique_ptr<Backdrop> backdrop;
  GLuint scene_target = 0, frame_buffer = 0;
  std::vector<std::uint8_t> pixels;
  Image image;
  View view;
  bool view_drawn = false;  // Whether `image` shows all of `view`.
  std::optional<FrameInputs>
      in_targets;  // What the targets and `pixels` were drawn from, if all from the same.
  DrawWork work;
  SurfaceImage surfaces;
  bool surfaces_known = true;  // Those of a view that shows nothing yet: none.
};

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
  glass_pass = std::make_unique<GlassPass>(
      gl, GlassPass::Scene{scene_target, settings.width, settings.height}, frameLines(settings));
  water_pass = std::make_unique<WaterPass>(
      gl, WaterPass::Scene{color, depth, settings.width, settings.height}, frameLines(settings));
  backdrop = std::make_unique<Backdrop>(
      gl, Backdrop::Request{settings.width, settings.height, frameLines(settings), quality.mirror});

  if (!scene_complete || !shadow_map.isComplete() || gl.GetError() != GL_NO_ERROR)
    throw NoImageMemory("images", settings.width, settings.height);
}

// One exposure or several, and their mean; the image at hand, where it is of the same.
const Image& FrameRenderer::Impl::draw(std::span<const Instance> instances, const Camera& camera,
                                       const std::function<void()>& drawn, std::span<const WaterVolume> water,
                                       std::span<const std::vector<Instance>> moments) {
  for (const Instance& instance : instances)
    REQUIRE(instance.solid >= 0 && instance.solid < geometry.solidCount(), instance.solid,
            geometry.solidCount());
  work = {};
  if (moments.empty() && showsAlready(instances, camera, water)) {
    if (drawn) drawn();
    return image;
  }
  view_drawn = false;
  view.instances.assign(instances.begin(), instances.end());
  view.camera = camera;
  view.ground = findGround(instances, geometry);
  view.water.assign(water.begin(), water.end());
  surfaces_known = false;
  context->makeCurrent();
  if (samples.size() > 1)
    exposeAll(moments, drawn);
  else
    exposeOnce(samples.front(), drawn);
  if (settings.cutout) unmultiply(image);
  if (samples.size() == 1 && view.water.empty() && view.inputs.glass.empty())
    in_targets = std::move(view.inputs);
  view_drawn = moments.empty();
  return image;
}

void FrameRenderer::Impl::exposeOnce(const Sample& sample, const std::function<void()>& drawn) {
  view.occlusion = occlusionTriangles();
  const std::vector<GridBlock> blocks = expose(sample);
  if (drawn) {
    gl.Finish();
    drawn();
  }
  readBack(blocks);
}

// The mean of the exposures, each through its place on the lens and at its moment.
void FrameRenderer::Impl::exposeAll(std::span<const std::vector<Instance>> moments,
                                    const std::function<void()>& drawn) {
  const Camera camera = view.camera;
  const std::vector<Instance> instances = view.instances;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    Sample sample = samples[i];
    view.camera = throughLens(camera, sample.lens, settings.height, sample.shift_px);
    if (!moments.empty()) view.instances = moments[i * moments.size() / samples.size()];
    exposeOnce(sample, i + 1 == samples.size() ? drawn : std::function<void()>());
    exposure.add(image);
  }
  exposure.develop(image);
  view.camera = camera;
  view.instances = instances;
}

// Whether a fresh drawing would be of the same values, bit by bit. Water moves; it is not worth comparing.
bool FrameRenderer::Impl::showsAlready(std::span<const Instance> instances, const Camera& camera,
                                       std::span<const WaterVolume> water) const {
  return view_drawn && water.empty() && view.water.empty() && isSame(camera, view.camera) &&
         std::equal(instances.begin(), instances.end(), view.instances.begin(), view.instances.end(),
                    [](const Instance& a, const Instance& b) { return isSame(a, b); });
}

// Adds the blocks' area to `area`, and the triangles drawn within them.
void FrameRenderer::Impl::count(std::span<const GridBlock> blocks, std::span<const BlockGroups> bodies,
                                std::int64_t& area) {
  for (const GridBlock& block : blocks) area += block.area();
  for (const BlockGroups& within : bodies) work.triangles += trianglesOf(within.groups);
}

// The passes: shadow map, mirrored bodies, sky and ground, bodies, the ground's shadows, contact shadows,
// water; each within the blocks that are not yet as they should be. Those of the image are returned.
std::vector<GridBlock> FrameRenderer::Impl::expose(const Sample& sample) {
  const ShadowCells shadows = castShadows(sample.to_light);
  view.inputs = inputsOf(sample, shadows);
  const FrameInputs& inputs = view.inputs;
  const FrameDamage damage = damageBy(inputs);
  in_targets.reset();
  const std::vector<GridBlock> blocks = damage.image.blocks();
  const ScreenBounds bounds(inputs.block, settings.width, settings.height);
  std::vector<InstanceRecord> records;
  const std::vector<BlockGroups> bodies = groupsWithin(
      blocks, inputs.visible, [&](const DrawnBody& body) { return bounds.of(body); }, records);
  const std::vector<BlockGroups> casters = groupsWithin(
      damage.shadow_map.blocks(), inputs.casting,
      [&](const DrawnBody& body) { return shadowMapBounds(inputs.block, body, quality.shadow_texels); },
      records);
  std::vector<DrawGroup> mirrored;
  for (const DrawnBody& body : drawnBodies(view.list.mirrored, view.list.records))
    appendTo(mirrored, records, body);

  std::vector<DrawGroup> glass;
  for (const DrawnBody& body : inputs.glass) {
    glass.push_back({body.mesh, body.look, static_cast<int>(records.size()), 1});
    records.push_back(body.record);
  }

  count(blocks, bodies, work.pixels);
  count(damage.shadow_map.blocks(), casters, work.shadow_texels);
  if (mirror_pass) work.mirror_texels += mirror_pass->texels();
  if (mirror_pass && inputs.ground_seen) work.triangles += trianglesOf(mirrored);
  uploadBlock(inputs.block);
  geometry.uploadInstances(gl, records);
  shadow_map.draw(casters, geometry);
  if (mirror_pass) {
    bindTextures();
    mirror_pass->draw(inputs.ground_seen ? mirrored : std::vector<DrawGroup>{}, geometry);
  }
  drawScene(inputs, blocks, bodies);
  drawOcclusion(inputs, blocks, bounds);
  glass_pass->draw(glass, geometry);
  water_pass->draw(view.water, view.camera, view.list.depth);
  return blocks;
}

// All of it where the targets hold something else than a frame of such inputs.
FrameDamage FrameRenderer::Impl::damageBy(const FrameInputs& inputs) const {
  const FrameSizes sizes{settings.width, settings.height, quality.shadow_texels};
  if (in_targets && view.water.empty() && inputs.glass.empty())
    return frameDamage(*in_targets, inputs, sizes);
  return wholeDamage(sizes);
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
  std::vector<FaceLight> lights =
      faceLights(view.shadow, to_light, bodies, focalLengthPixels(camera, settings.height));
  if (view.ground) lights.insert(lights.begin() + *view.ground, FaceLight{});
  view.list = buildDrawList(view.instances, camera, settings, geometry, lights);
  return {view.shadow, casters};
}

FrameInputs FrameRenderer::Impl::inputsOf(const Sample& sample, const ShadowCells& shadows) const {
  const DrawList& list = view.list;
  FrameInputs inputs;
  inputs.block = blockOf(sample, view.shadow);
  inputs.ground_seen = list.ground && list.ground_z_E < 0.0;
  if (list.ground) inputs.ground_pattern = view.instances[static_cast<std::size_t>(*list.ground)].pattern;
  inputs.visible = drawnBodies(list.visible, list.records);
  inputs.glass = drawnBodies(list.glass, list.records);
  if (view.shadow.texel_m > 0.0) inputs.casting = drawnBodies(list.casting, list.records);
  if (inputs.ground_seen && inputs.block.to_light[2] > 0.0f)
    inputs.ground_shadows =
        shadows.groundTriangles(list.ground_z_E, kShadowsOverHorizon * horizonDistance(view.camera));
  inputs.occlusion = view.occlusion;
  return inputs;
}

FrameBlock FrameRenderer::Impl::blockOf(const Sample& sample, const ShadowView& shadow) const {
  const std::optional<double> ground_z_E =
      view.list.ground ? std::optional(view.list.ground_z_E) : std::nullopt;
  const Color color =
      view.list.ground ? view.instances[static_cast<std::size_t>(*view.list.ground)].color : Color();
  return frameBlock({view.camera, settings.width, settings.height, view.list.depth, shadow,
                     quality.shadow_texels, sample, ground_z_E, color, settings.light.pool});
}

void FrameRenderer::Impl::uploadBlock(const FrameBlock& block) const {
  gl.BindBuffer(GL_UNIFORM_BUFFER, frame_buffer);
  gl.BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_buffer);
}

void FrameRenderer::Impl::bindTextures() const {
  geometry.pictures().bind(gl);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, mirror_pass ? mirror_pass->texture() : 0);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, shadow_map.texture());
}

void FrameRenderer::Impl::drawScene(const FrameInputs& inputs, std::span<const GridBlock> blocks,
                                    std::span<const BlockGroups> bodies) {
  bindTextures();
  backdrop->copyTo(scene_target, inputs, blocks);
  gl.Viewport(0, 0, settings.width, settings.height);
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  gl.Enable(GL_DEPTH_TEST);
  gl.Disable(GL_BLEND);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LEQUAL);
  gl.Enable(GL_CULL_FACE);
  gl.Enable(GL_SCISSOR_TEST);
  for (const auto& [block, groups] : bodies) {
    setScissor(gl, block);
    for (const DrawGroup& group : groups) {
      gl.UseProgram(body_programs.of(group.look));
      geometry.draw(gl, group.range, group.first, group.count);
    }
  }
  gl.Disable(GL_SCISSOR_TEST);
  backdrop->drawShadows(inputs, blocks);
}

std::vector<OcclusionTriangle> FrameRenderer::Impl::occlusionTriangles() const {
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

void FrameRenderer::Impl::drawOcclusion(const FrameInputs& inputs, std::span<const GridBlock> blocks,
                                        const ScreenBounds& bounds) const {
  std::vector<BlockOcclusion> within;
  for (const GridBlock& block : blocks) within.push_back({block, {}});
  for (const OcclusionTriangle& triangle : inputs.occlusion) {
    const GridBlock seen = bounds.of(triangle);
    for (BlockOcclusion& part : within)
      if (seen.meets(part.block)) part.triangles.push_back(triangle);
  }
  occlusion_pass.draw(within);
}

void FrameRenderer::Impl::readBack(std::span<const GridBlock> blocks) {
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.PixelStorei(GL_PACK_ROW_LENGTH, settings.width);
  for (const GridBlock& b : blocks) {
    const std::size_t first = static_cast<std::size_t>(b.y_begin) * static_cast<std::size_t>(settings.width) +
                              static_cast<std::size_t>(b.x_begin);
    gl.ReadPixels(b.x_begin, b.y_begin, b.x_end - b.x_begin, b.y_end - b.y_begin, GL_RGBA, GL_UNSIGNED_BYTE,
                  pixels.data() + 4 * first);
  }
  gl.PixelStorei(GL_PACK_ROW_LENGTH, 0);
  if (image.rgb.empty() || settings.cutout || isWhole(blocks, settings))
    filter.apply(pixels, image);
  else
    filter.applyAgain(pixels, blocks, image);
  if (settings.cutout) filter.applyToAlpha(pixels, image);
}

const SurfaceImage& FrameRenderer::Impl::knownSurfaces() {
  if (surfaces_known) return surfaces;
  context->makeCurrent();
  if (samples.size() > 1)
    castShadows(samples.front().to_light);  // The list of the last exposure is as it saw it.
  uploadBlock(blockOf({}, {}));
  surface_pass.draw(view.instances, solids, view.camera, view.list, geometry, surfaces);
  surfaces_known = true;
  return surfaces;
}

FrameRenderer::FrameRenderer(const Settings& settings, std::span<const Solid> solids)
    : impl_(std::make_unique<Impl>(settings, solids)) {}
FrameRenderer::~FrameRenderer() = default;

const Image& FrameRenderer::draw(std::span<const Instance> instances, const Camera& camera,
                                 const std::function<void()>& drawn, std::span<const WaterVolume> water,
                                 std::span<const std::vector<Instance>> moments) {
  return impl_->draw(instances, camera, drawn, water, moments);
}
void FrameRenderer::drawAnew() {
  impl_->view_drawn = false;
  impl_->in_targets.reset();
}

int FrameRenderer::exposures() const {
  return static_cast<int>(impl_->samples.size());
}
const SurfaceImage& FrameRenderer::surfaces() {
  return impl_->knownSurfaces();
}
const DrawWork& FrameRenderer::work() const {
  return impl_->work;
}
ContextInfo FrameRenderer::info() const {
  return impl_->context->info();
}

}  // namespace carom::renderer
