#include "renderer/draw/draw_list.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace carom::renderer {
namespace {

constexpr double kLevelTop = 0.9999;         // Cosine between a ground's own axis and the vertical.
constexpr double kFarOverDistance = 4000.0;  // Far plane over the distance from eye to target.
constexpr double kMinNearOverDistance = 1e-3;
constexpr double kNearsPerDoubling = 2.0;
constexpr double kPixelsPerTriangle = 3.0;  // Squares of a radius that one more triangle is worth.
constexpr double kWidestShaded_px =
    1.5;  // A narrower bevel of triangles would show in a pixel here and there.
constexpr double kGroundDarkening = 0.7;  // Of a body's half height: how near the ground darkens it.

// An instance placed relative to the eye.
struct Placed {
  int index = 0;
  Vec3 center_E = Vec3::Zero();
  double radius_m = 0.0;
  double depth_m = 0.0;  // Of the centre, along the view.
  int level = 0;
  BodyLook look;
  double radius_px = 0.0;
  FaceMask faces = kAllFaces;
  FaceMask sunlit = kAllFaces;
};

Placed place(int index, const Instance& instance, const SolidGeometry& solid, const Camera& camera,
             const CameraAxes& axes, double focal_px) {
  Placed placed;
  placed.index = index;
  placed.center_E = instance.X_WB * solid.extent.center - camera.eye;
  placed.radius_m = solid.extent.half.norm();
  placed.depth_m = placed.center_E.dot(axes.forward);
  const double distance = std::max(placed.center_E.norm() - placed.radius_m, 1e-3 * placed.radius_m);
  placed.radius_px = focal_px * solid.extent.half.maxCoeff() / distance;
  placed.level = detailLevel(placed.radius_px);
  if (focal_px * solid.bevel_m < kWidestShaded_px * distance)
    placed.level = std::min(placed.level, solid.is_curved ? kSharpLevel : kLastShadedLevel);
  placed.look.finish = static_cast<std::int32_t>(instance.checker ? static_cast<int>(instance.pattern)
                                                                  : static_cast<int>(instance.surface.kind));
  if (instance.checker) placed.look.shader = BodyShader::kChecker;
  return placed;
}

// Whether it is large enough on the image for look-ups on half of it to cost more than its triangles.
bool isWorthSplitting(const Placed& placed, const SolidGeometry& solid) {
  const int triangles = solid.levels[static_cast<std::size_t>(placed.level)].count / 3;
  return placed.radius_px * placed.radius_px > kPixelsPerTriangle * triangles;
}

// What draws it: one without and one with shadows to look up, each with its faces, or one as a whole.
void appendVisible(const Placed& whole, bool is_checker, const SolidGeometry& solid, const FaceLight& light,
                   std::vector<Placed>& visible) {
  const auto add = [&](BodyShader shader, FaceMask faces) {
    if (faces == 0) return;
    visible.push_back(whole);
    visible.back().look.shader = shader;
    visible.back().faces = faces;
    if (shader == BodyShader::kSunlit) visible.back().sunlit = light.sunlit;
  };
  const FaceMask known = light.sunlit | light.turned;
  const bool split =
      drawsSingleFaces(whole.level) && (known == 0 || light.shadowed == 0 || isWorthSplitting(whole, solid));
  if (is_checker) {
    add(BodyShader::kChecker, kAllFaces);
  } else if (split) {
    add(BodyShader::kSunlit, known);
    add(BodyShader::kShadowed, light.shadowed);
  } else if (light.turned == 0 && light.shadowed == 0) {
    visible.push_back(whole);
    visible.back().look.shader = BodyShader::kSunlit;
  } else {
    add(BodyShader::kShadowed, drawsSingleFaces(whole.level) ? known | light.shadowed : kAllFaces);
  }
}

// Whether the bounding ball reaches into the view's pyramid.
bool inView(const Placed& placed, const CameraAxes& axes, double half_width, double half_height) {
  if (placed.depth_m < -placed.radius_m) return false;
  const double across = std::abs(placed.center_E.dot(axes.right)),
               up = std::abs(placed.center_E.dot(axes.up));
  return across - half_width * placed.depth_m <= placed.radius_m * std::hypot(1.0, half_width) &&
         up - half_height * placed.depth_m <= placed.radius_m * std::hypot(1.0, half_height);
}

using Meshes = std::array<MeshRange, kDetailLevels> SolidGeometry::*;

// Groups of neighbours in `placed` (whose records begin with number `first`) that share mesh and shader, the
// group with the nearest instance first.
std::vector<DrawGroup> group(const std::vector<Placed>& placed, Meshes meshes,
                             std::span<const Instance> instances, const SceneGeometry& geometry, int first) {
  struct Ordered {
    double nearest_m;
    DrawGroup group;
  };
  std::vector<Ordered> ordered;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Placed& p = placed[i];
    const SolidGeometry& solid = geometry.solid(instances[static_cast<std::size_t>(p.index)].solid);
    const MeshRange& range = (solid.*meshes)[static_cast<std::size_t>(p.level)];
    if (ordered.empty() || ordered.back().group.look != p.look || !(ordered.back().group.range == range))
      ordered.push_back({p.depth_m - p.radius_m, {range, p.look, first + static_cast<int>(i), 0}});
    ++ordered.back().group.count;
  }
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Ordered& a, const Ordered& b) { return a.nearest_m < b.nearest_m; });
  std::vector<DrawGroup> groups;
  for (const Ordered& o : ordered) groups.push_back(o.group);
  return groups;
}

// As far away as nothing visible allows, since precision in depth is lost in proportion to far over near; in
// steps, so that a view stays the same while bodies move through it.
DepthRange depthRange(const std::vector<Placed>& visible, double distance_m, const DrawList& list) {
  double near = distance_m, far = kFarOverDistance * distance_m;
  for (const Placed& p : visible) {
    near = std::min(near, 0.9 * (p.depth_m - p.radius_m));
    far = std::max(far, 1.1 * (p.depth_m + p.radius_m));
  }
  if (list.ground) near = std::min(near, 0.3 * std::abs(list.ground_z_E));
  near = std::max(near, kMinNearOverDistance * distance_m);
  return {std::exp2(std::floor(std::log2(near) * kNearsPerDoubling) / kNearsPerDoubling), far};
}

bool isGlass(const Instance& instance) {
  return !instance.checker && instance.surface.kind == SurfaceKind::kGlass;
}

void setFinish(const Surface& surface, const Extent& extent, bool is_ball, InstanceRecord& record) {
  if (surface.kind == SurfaceKind::kPlain) return;
  const SurfaceFrame frame = surfaceFrame(surface, extent.half);
  record.finish[0] = static_cast<float>(1.0 / surface.scale_m);
  record.finish[1] = static_cast<float>(frame.axis);
  record.finish[2] = static_cast<float>(frame.number);
  for (int i = 0; i < 3; ++i) record.half[i] = static_cast<float>(extent.half[i]);
  record.half[3] = is_ball ? 1.0f : 0.0f;
}

}  // namespace

InstanceRecord instanceRecord(const Instance& instance, const SolidGeometry& solid, const Camera& camera) {
  const Mat3 rotation = instance.X_WB.rotation.toRotationMatrix();
  const Vec3 position = instance.X_WB.position - camera.eye;
  InstanceRecord r{};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) r.rows[i][k] = static_cast<float>(rotation(i, k));
    r.rows[i][3] = static_cast<float>(position[i]);
  }
  r.color[0] = linearLight(instance.color.r);
  r.color[1] = linearLight(instance.color.g);
  r.color[2] = linearLight(instance.color.b);
  const double reach = kGroundDarkening * solid.extent.half.minCoeff();
  r.color[3] = static_cast<float>(instance.checker ? -reach : reach);
  r.faces = kAllFaces;
  r.sunlit = kAllFaces;
  setFinish(instance.surface, solid.extent, solid.is_ball, r);
  return r;
}

double topHeight(const Instance& instance, const SolidGeometry& solid) {
  const Vec3 up_B = instance.X_WB.rotation.conjugate() * Vec3::UnitZ();
  return (instance.X_WB * solid.extent.center).z() + up_B.cwiseAbs().dot(solid.extent.half);
}

std::optional<int> findGround(std::span<const Instance> instances, const SceneGeometry& geometry) {
  std::optional<int> ground;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    if (!instance.checker || geometry.solid(instance.solid).is_round) continue;
    const Vec3 up_B = instance.X_WB.rotation.conjugate() * Vec3::UnitZ();
    if (up_B.cwiseAbs().maxCoeff() < kLevelTop) continue;
    const double top = topHeight(instance, geometry.solid(instance.solid));
    if (top < lowest) lowest = top, ground = static_cast<int>(i);
  }
  return ground;
}

DrawList buildDrawList(std::span<const Instance> instances, const Camera& camera, const Settings& settings,
                       const SceneGeometry& geometry, std::span<const FaceLight> lights) {
  DrawList list;
  const CameraAxes axes = cameraAxes(camera);
  const double focal = focalLengthPixels(camera, settings.height);
  const double half_height = 0.5 * settings.height / focal, half_width = 0.5 * settings.width / focal;
  list.ground = findGround(instances, geometry);
  if (list.ground) {
    const Instance& ground = instances[static_cast<std::size_t>(*list.ground)];
    list.ground_z_E = topHeight(ground, geometry.solid(ground.solid)) - camera.eye.z();
  }
  std::vector<Placed> visible, casting, glass;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const int index = static_cast<int>(i);
    if (list.ground == index) continue;
    const Placed placed = place(index, instances[i], geometry.solid(instances[i].solid), camera, axes, focal);
    const bool in_view = inView(placed, axes, half_width, half_height);
    if (in_view && isGlass(instances[i]))
      glass.push_back(placed);
    else if (in_view)
      appendVisible(placed, instances[i].checker, geometry.solid(instances[i].solid), lights[i], visible);
    casting.push_back(placed);
  }
  const auto byMesh = [&](const Placed& a, const Placed& b) {
    const auto key = [&](const Placed& p) {
      return std::tuple(instances[static_cast<std::size_t>(p.index)].solid, p.level, p.look, p.depth_m,
                        p.index, p.sunlit);
    };
    return key(a) < key(b);
  };
  const int seen = static_cast<int>(visible.size());
  for (std::vector<Placed>* placed : {&visible, &casting}) {
    std::sort(placed->begin(), placed->end(), byMesh);
    for (const Placed& p : *placed) {
      const Instance& instance = instances[static_cast<std::size_t>(p.index)];
      list.records.push_back(instanceRecord(instance, geometry.solid(instance.solid), camera));
      list.records.back().faces = p.faces;
      list.records.back().sunlit = p.sunlit;
    }
  }
  list.visible = group(visible, &SolidGeometry::levels, instances, geometry, 0);
  std::stable_sort(glass.begin(), glass.end(),
                   [](const Placed& a, const Placed& b) { return a.depth_m > b.depth_m; });
  for (const Placed& p : glass) {
    const Instance& instance = instances[static_cast<std::size_t>(p.index)];
    const SolidGeometry& solid = geometry.solid(instance.solid);
    list.glass.push_back(
        {solid.levels[static_cast<std::size_t>(p.level)], p.look, static_cast<int>(list.records.size()), 1});
    list.records.push_back(instanceRecord(instance, solid, camera));
  }
  visible.insert(visible.end(), glass.begin(), glass.end());
  list.depth = depthRange(visible, (camera.target - camera.eye).norm(), list);
  list.casting = group(casting, &SolidGeometry::casting, instances, geometry, seen);
  if (qualityOf(settings).mirror)
    list.mirrored = group(casting, &SolidGeometry::levels, instances, geometry, seen);
  return list;
}

}  // namespace carom::renderer
