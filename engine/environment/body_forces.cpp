#include "engine/environment/body_forces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace carom {
namespace {

// Gauss's rule with four points on (-1/2, 1/2): places along a capsule's axis and their shares.
constexpr std::array<std::array<double, 2>, 4> kStrips{{{-0.43056815579702629, 0.17392742256872693},
                                                        {-0.16999052179242813, 0.32607257743127307},
                                                        {0.16999052179242813, 0.32607257743127307},
                                                        {0.43056815579702629, 0.17392742256872693}}};

constexpr double kHoldDepth = 0.1;  // of a part's width: as deep, the fluid's drag has full hold

// The planes that bound a fluid, in the body's frame; the first is the surface.
struct FluidPlanes {
  std::array<Plane, 6> planes;
  std::size_t count = 0;

  void add(const Vec3& normal_W, double offset_W, const Pose& X_WB) {
    planes[count++] = {X_WB.rotation.conjugate() * normal_W, offset_W - dot(normal_W, X_WB.position)};
  }
};

FluidPlanes planesOf(const Fluid& fluid, double gravity_mps2, const Pose& X_WB, double t_s) {
  FluidPlanes planes;
  const SurfacePoint surface = surfaceAt(fluid, gravity_mps2, X_WB.position.head<2>(), t_s);
  const Vec3 up = Vec3(-surface.slope.x(), -surface.slope.y(), 1.0).normalized();
  planes.add(up, dot(up, Vec3(X_WB.position.x(), X_WB.position.y(), surface.height_m)), X_WB);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::isfinite(fluid.min[axis])) planes.add(-Vec3::Unit(axis), -fluid.min[axis], X_WB);
    if (axis < 2 && std::isfinite(fluid.max[axis])) planes.add(Vec3::Unit(axis), fluid.max[axis], X_WB);
  }
  return planes;
}

// How one part lies in a fluid: outside, wholly within, or cut by some of its planes.
struct PartCut {
  bool outside = false;
  std::array<Plane, 6> planes;
  std::size_t count = 0;

  std::span<const Plane> region() const { return {planes.data(), count}; }
};

PartCut cutOf(const PartSurface& part, const FluidPlanes& fluid) {
  PartCut cut;
  for (std::size_t i = 0; i < fluid.count; ++i) {
    const double height = fluid.planes[i].signedDistance(part.part->core.center());
    if (height >= part.reach_m) cut.outside = true;
    if (height > -part.reach_m) cut.planes[cut.count++] = fluid.planes[i];
  }
  return cut;
}

// The exact share of one plane, the product of the shares of several.
VolumeMoments cutRoundedPart(const PartSurface& part, const PartCut& cut, RoundedScratch& scratch) {
  if (cut.count == 0) return part.whole;
  VolumeMoments product = cutRounded(*part.part, cut.planes[0], scratch);
  Vec3 centroid = product.volume_m3 > 0.0 ? product.centroid() : Vec3::Zero();
  for (std::size_t i = 1; i < cut.count; ++i) {
    const VolumeMoments one = cutRounded(*part.part, cut.planes[i], scratch);
    if (!(one.volume_m3 > 0.0)) return {};
    product.volume_m3 *= one.volume_m3 / part.whole.volume_m3;
    centroid += one.centroid() - part.whole.centroid();
  }
  product.first_m4 = product.volume_m3 * centroid;
  return product;
}

// The wet share of a ball of radius r about a point, between 0 and 1.
double wetShare(const Vec3& p_B, double r, const PartCut& cut) {
  double share = 1.0;
  for (const Plane& plane : cut.region())
    share *= std::clamp(0.5 - 0.5 * plane.signedDistance(p_B) / r, 0.0, 1.0);
  return share;
}

/// A stream as it acts on one part: 1/2 rho times the factor of the body's coefficient, and the linear drag.
struct Stream {
  double half_density = 0.0;
  double linear = 0.0;    ///< kg/(m^2 s).
  double friction = 0.0;  ///< 1/2 rho C_f.
  Hold hold = {};
};

void dragFacets(const FacetList& list, const Stream& stream, double coefficient, CutScratch& scratch,
                StreamDrag& drag) {
  for (const Facet& facet : list.facets) {
    const std::span<const Vec3> corners = list.cornersOf(facet);
    if (stream.half_density > 0.0)
      addPressure(corners, facet.normal, stream.half_density * coefficient, stream.hold, scratch, drag);
    if (stream.friction > 0.0) addSkinFriction(corners, facet.normal, stream.friction, drag);
    if (stream.linear > 0.0) addLinear(corners, facet.normal, stream.linear, stream.hold, scratch, drag);
  }
}

// `share` of the ball lies in the stream, about `p_B`.
void dragBall(const PartSurface& part, const Vec3& p_B, double share, const Stream& stream,
              double coefficient, StreamDrag& drag) {
  const double r = part.part->radius_m;
  addPointDrag(p_B, share * stream.half_density * coefficient * std::numbers::pi * r * r, Vec3::Zero(), drag);
  const double area = share * part.area_m2 * stream.linear;
  if (area > 0.0) addPointLinear(p_B, area, area * 2.0 / 3.0 * r * r, drag);
}

// A capsule by strips across its axis, each with the speed it has itself, and its two ends as halves of a
// ball.
void dragCapsule(const PartSurface& part, const PartCut& cut, bool wet, const Stream& stream,
                 std::optional<double> own, StreamDrag& drag) {
  const Edge& edge = part.part->core.edge(0);
  const Vec3 middle = 0.5 * (part.part->core.vertex(0) + part.part->core.vertex(1));
  const double r = part.part->radius_m, length = edge.length_m;
  const auto shareAt = [&](const Vec3& p) {
    const double share = cut.outside ? 0.0 : wetShare(p, r, cut);
    return wet ? share : 1.0 - share;
  };
  for (const auto& [place, weight] : kStrips) {
    const Vec3 p = middle + place * length * edge.direction;
    const double share = shareAt(p) * weight;
    addPointDrag(p, share * stream.half_density * own.value_or(kCylinderDrag) * 2.0 * r * length,
                 edge.direction, drag);
    const double linear = share * 2.0 * std::numbers::pi * r * length * stream.linear;
    addPointLinear(p, linear, linear * 2.0 / 3.0 * r * r, drag);
  }
  for (int v = 0; v < 2; ++v) {
    const Vec3& p = part.part->core.vertex(v);
    const double share = 0.5 * shareAt(p);
    addPointDrag(p, share * stream.half_density * own.value_or(kBallDrag) * std::numbers::pi * r * r,
                 Vec3::Zero(), drag);
    const double linear = share * 4.0 * std::numbers::pi * r * r * stream.linear;
    addPointLinear(p, linear, linear * 2.0 / 3.0 * r * r, drag);
  }
}

void addStream(const StreamDrag& drag, const Vec6& velocity, BodyForces& forces) {
  const Vec6 stream = velocity - drag.velocity;
  forces.quadratic += drag.quadratic;
  forces.linear += drag.linear;
  forces.quadratic_stream += drag.quadratic * stream;
  forces.linear_stream += drag.linear * stream;
}

// The body as it is computed with.
struct Acting {
  const Environment& environment;
  const EnvironmentBody& body;
  const Pose& X_WB;
  const Vec6& velocity;
  double t_s;
  ForceScratch& scratch;
  BodyForces& forces;

  Vec6 relativeTo(const Vec3& stream_W) const {
    Vec6 u = velocity;
    u.head<3>() -= X_WB.rotation.conjugate() * stream_W;
    return u;
  }
};

// The motion of the water around the whole body: where the middle of its wetted part is.
WaterMotion waterAround(const Acting& a, const Fluid& fluid, double gravity) {
  if (fluid.waves.empty()) return {fluid.flow, Vec3::Zero()};
  const VolumeMoments wet = submergedPart(*a.body.surface, fluid, gravity, a.X_WB, a.t_s, a.scratch);
  const Vec3 middle = wet.volume_m3 > 0.0 ? Vec3(a.X_WB * wet.centroid()) : a.X_WB.position;
  return waterMotionAt(fluid, gravity, middle, a.t_s);
}

void addBuoyancy(const Acting& a, const Fluid& fluid, const VolumeMoments& wet, const WaterMotion& water) {
  const Vec3 fall_B = a.X_WB.rotation.conjugate() * (a.environment.gravity - water.acceleration);
  const Vec3 lift = -fluid.density_kgpm3 * wet.volume_m3 * fall_B;
  const Vec3 center = wet.centroid();
  a.forces.load.head<3>() += lift;
  a.forces.load.tail<3>() += center.cross(lift);
  a.forces.submerged_m3 += wet.volume_m3;
  if (!(fluid.added_mass > 0.0)) return;
  const double mass = fluid.added_mass * fluid.density_kgpm3 * wet.volume_m3;
  const Mat3 r = crossMatrix(center);
  Mat6 added = Mat6::Zero();
  added.topLeftCorner<3, 3>() = mass * Mat3::Identity();
  added.topRightCorner<3, 3>() = -mass * r;
  added.bottomLeftCorner<3, 3>() = mass * r;
  added.bottomRightCorner<3, 3>() = -mass * r * r;
  a.forces.added_mass += added;
  const Vec3 along = mass * (a.X_WB.rotation.conjugate() * water.acceleration);
  a.forces.load.head<3>() += along;
  a.forces.load.tail<3>() += center.cross(along);
}

// What of a polyhedron lies behind the planes; its faces there, and the others.
VolumeMoments cutSurface(const PartSurface& part, std::span<const Plane> region, ForceScratch& s) {
  if (!part.open) return cutPolyhedron(part.facets(), region, s.cut.cut, &s.wet, &s.dry);
  cutFacets(*part.open, region, s.cut.cut, s.wet, &s.dry);
  return cutPolyhedron(part.facets(), region, s.cut.cut, nullptr, nullptr);
}

// One part in one fluid: the displaced volume, and its drag collected in `drag`.
VolumeMoments immersePart(const Acting& a, const PartSurface& part, const FluidPlanes& planes,
                          const Stream& stream, StreamDrag& drag, double& dry_share) {
  const PartCut cut = cutOf(part, planes);
  if (cut.outside) return {};
  ForceScratch& s = a.scratch;
  const std::optional<double> own = a.body.drag_coefficient;
  if (part.form == PartSurface::Form::kPolyhedron) {
    s.wet.clear();
    s.dry.clear();
    VolumeMoments wet = cutSurface(part, cut.region(), s);
    if (cut.count == 0)
      wet = part.whole;
    else if (part.bevelled)
      wet = cutRoundedPart(part, cut, s.cut);
    Stream held = stream;
    const double width = part.part->width();
    if (planes.planes[0].signedDistance(part.part->core.center()) > -part.reach_m - kHoldDepth * width)
      held.hold = {planes.planes[0], 1.0 / (kHoldDepth * width)};
    dragFacets(s.wet, held, own.value_or(kFaceDrag), s.cut.cut, drag);
    return wet;
  }
  const VolumeMoments wet = cutRoundedPart(part, cut, s.cut);
  const double share = std::clamp(wet.volume_m3 / part.whole.volume_m3, 0.0, 1.0);
  dry_share -= share;
  if (!(share > 0.0)) return wet;
  if (part.form == PartSurface::Form::kBall)
    dragBall(part, wet.centroid(), share, stream, own.value_or(kBallDrag), drag);
  else
    dragCapsule(part, cut, true, stream, own, drag);
  return wet;
}

// Air on what of the part no fluid covers; of several fluids that touch it, the first one's planes decide
// where its facets are dry.
void blowOnPart(const Acting& a, const PartSurface& part, const FluidPlanes* planes, double dry_share,
                StreamDrag& drag) {
  const Air& air = a.environment.air;
  const Stream stream{0.5 * air.density_kgpm3, 0.0, 0.5 * air.density_kgpm3 * air.skin_friction, {}};
  PartCut cut;
  cut.outside = true;
  if (planes != nullptr) cut = cutOf(part, *planes);
  ForceScratch& s = a.scratch;
  const std::optional<double> own = a.body.drag_coefficient;
  if (part.form == PartSurface::Form::kPolyhedron) {
    s.wet.clear();
    s.dry.clear();
    if (!cut.outside)
      cutSurface(part, cut.region(), s);
    else if (part.open)
      cutFacets(*part.open, {}, s.cut.cut, s.dry, nullptr);
    else
      cutPolyhedron(part.facets(), {}, s.cut.cut, &s.dry, nullptr);
    dragFacets(s.dry, stream, own.value_or(kFaceDrag), s.cut.cut, drag);
  } else if (part.form == PartSurface::Form::kBall) {
    if (dry_share > 0.0)
      dragBall(part, part.whole.centroid(), dry_share, stream, own.value_or(kBallDrag), drag);
  } else {
    dragCapsule(part, cut, false, stream, own, drag);
  }
}

}  // namespace

bool reaches(const Fluid& fluid, const Vec3& center_W, double reach_m) {
  const Vec3 high = fluid.max + Vec3(0.0, 0.0, fluid.waveHeight());
  return (center_W.array() + reach_m > fluid.min.array()).all() &&
         (center_W.array() - reach_m < high.array()).all();
}

BodyForces bodyForces(const Environment& environment, const EnvironmentBody& body, const Pose& X_WB,
                      const Vec6& velocity, double t_s, ForceScratch& scratch) {
  BodyForces forces;
  const Acting a{environment, body, X_WB, velocity, t_s, scratch, forces};
  const double gravity = environment.gravity.norm();
  forces.load.head<3>() = body.inertia->mass_kg * (X_WB.rotation.conjugate() * environment.gravity);
  if (body.load != nullptr) {
    forces.load.head<3>() += X_WB.rotation.conjugate() * body.load->force_W + body.load->force_B;
    forces.load.tail<3>() += X_WB.rotation.conjugate() * body.load->torque_W + body.load->torque_B;
  }
  StreamDrag wind;
  wind.velocity = a.relativeTo(environment.air.wind);
  for (const PartSurface& part : body.surface->parts) {
    double dry_share = 1.0;
    std::optional<FluidPlanes> first;
    for (const Fluid& fluid : environment.fluids) {
      if (!reaches(fluid, X_WB * part.part->core.center(), part.reach_m)) continue;
      const FluidPlanes planes = planesOf(fluid, gravity, X_WB, t_s);
      const WaterMotion water = waterAround(a, fluid, gravity);
      StreamDrag drag;
      drag.velocity = a.relativeTo(water.velocity);
      const Stream stream{0.5 * fluid.density_kgpm3 * fluid.drag, fluid.density_kgpm3 * fluid.linear_drag_mps,
                          0.0};
      const VolumeMoments wet = immersePart(a, part, planes, stream, drag, dry_share);
      if (!(wet.volume_m3 > 0.0)) continue;
      addBuoyancy(a, fluid, wet, water);
      addStream(drag, velocity, forces);
      if (!first) first = planes;
    }
    if (environment.air.density_kgpm3 > 0.0) blowOnPart(a, part, first ? &*first : nullptr, dry_share, wind);
  }
  addStream(wind, velocity, forces);
  return forces;
}

VolumeMoments submergedPart(const SolidSurface& surface, const Fluid& fluid, double gravity_mps2,
                            const Pose& X_WB, double t_s, ForceScratch& scratch) {
  const FluidPlanes planes = planesOf(fluid, gravity_mps2, X_WB, t_s);
  VolumeMoments sum;
  for (const PartSurface& part : surface.parts) {
    const PartCut cut = cutOf(part, planes);
    if (cut.outside) continue;
    VolumeMoments wet = part.whole;
    if (cut.count > 0)
      wet = part.part->radius_m > 0.0
                ? cutRoundedPart(part, cut, scratch.cut)
                : cutPolyhedron(part.part->core, cut.region(), scratch.cut.cut, nullptr, nullptr);
    sum.volume_m3 += wet.volume_m3;
    sum.first_m4 += wet.first_m4;
  }
  return sum;
}

double buoyancyPotential(const Environment& environment, const SolidSurface& surface, const Pose& X_WB,
                         double t_s, ForceScratch& scratch) {
  double energy = 0.0;
  const double gravity = environment.gravity.norm();
  for (const Fluid& fluid : environment.fluids) {
    if (!reaches(fluid, X_WB.position, surface.radius_m)) continue;
    const VolumeMoments wet = submergedPart(surface, fluid, gravity, X_WB, t_s, scratch);
    if (!(wet.volume_m3 > 0.0)) continue;
    const SurfacePoint top = surfaceAt(fluid, gravity, X_WB.position.head<2>(), t_s);
    const Vec3 above(X_WB.position.x(), X_WB.position.y(), top.height_m);
    energy += fluid.density_kgpm3 * wet.volume_m3 * dot(environment.gravity, X_WB * wet.centroid() - above);
  }
  return energy;
}

}  // namespace carom
