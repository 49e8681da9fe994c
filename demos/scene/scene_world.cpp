#include "demos/scene/scene_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "demos/asset/asset_path.h"
#include "demos/asset/mesh_companions.h"
#include "demos/format/content_hash.h"
#include "demos/formula/random_stream.h"
#include "demos/scene/body_palette.h"
#include "demos/scene/run_extent.h"
#include "demos/scene/shape_solid.h"
#include "engine/broad_phase/candidate_pairs.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/elementary.h"
#include "renderer/view/solid_extent.h"

namespace carom::demos {
namespace {

using Mesh = std::optional<std::filesystem::path>;
using std::numbers::pi;

/// One stream for each copy of a body.
RandomStream jitterStream(std::uint64_t seed, std::size_t body, int copy) {
  return RandomStream(seed * 0x9e3779b97f4a7c15ull + body * 0xbf58476d1ce4e5b9ull +
                      static_cast<std::uint64_t>(copy));
}

Vec3 placeOfCopy(const Repeat& repeat, int copy) {
  if (!repeat.copies.empty()) return repeat.copies[static_cast<std::size_t>(copy)].position;
  const Vec3 cell(copy % repeat.count[0], copy / repeat.count[0] % repeat.count[1],
                  copy / (repeat.count[0] * repeat.count[1]));
  return cell.cwiseProduct(repeat.step_m);
}

Pose poseOfCopy(const Body& body, std::uint64_t seed, std::size_t index, int copy) {
  const Repeat& repeat = body.repeat;
  RandomStream random = jitterStream(seed, index, copy);
  Pose X_WS = body.X_WS;
  X_WS.position += placeOfCopy(repeat, copy) + repeat.jitter_m * random.vector();
  if (!repeat.copies.empty())
    X_WS.rotation = (repeat.copies[static_cast<std::size_t>(copy)].rotation * X_WS.rotation).normalized();
  if (repeat.turn_degrees != 0.0) {
    const double radians = repeat.turn_degrees * pi / 180.0 * copy;
    X_WS.rotation = (rotationBy(repeat.turn_axis * radians) * X_WS.rotation).normalized();
  }
  if (repeat.jitter_degrees > 0.0) {
    const Vec3 axis = random.direction();
    const double radians = repeat.jitter_degrees * pi / 180.0 * random.signedUnit();
    X_WS.rotation = (rotationBy(axis * radians) * X_WS.rotation).normalized();
  }
  return body.in_group ? body.X_WG * X_WS : X_WS;
}

/// What a group has carried away is as near as any other body.
void requireNear(const Body& body, const Vec3& p_W) {
  if (p_W.cwiseAbs().maxCoeff() > kLargestLength_m)
    throw InputError(body.place + ": its group takes it farther than accepted: " +
                     std::to_string(kLargestLength_m) + " m along each axis");
}

bool isReplaceable(const Shape& shape) {
  if (const auto* hull = std::get_if<HullShape>(&shape.form)) return hull->replaceable;
  if (const auto* compound = std::get_if<CompoundShape>(&shape.form)) {
    for (const CompoundPart& part : compound->parts)
      if (isReplaceable(part.shape)) return true;
  }
  return false;
}

void requireReplaceableHull(const Scene& scene) {
  for (const Body& body : scene.bodies)
    if (isReplaceable(body.shape)) return;
  throw InputError(scene.file.string() + ": takes no --mesh: no mesh in it says \"replaceable\": true");
}

// How it is moved, and of what mass it is.
void setMotion(const Body& body, const Solid& solid, const Pose& X_SB, BodyDescription& description) {
  description.mass_kg = body.mass_kg;
  if (body.mass_kg) {
    const double density = *body.mass_kg / solid.volume();
    if (!(density >= kSmallestDensity_kgpm3 && density <= kLargestDensity_kgpm3)) {
      std::ostringstream text;
      text << body.place << ": a mass of " << *body.mass_kg << " kg makes a density of " << density
           << " kg/m^3; accepted: a density of " << kSmallestDensity_kgpm3 << " to " << kLargestDensity_kgpm3;
      throw InputError(text.str());
    }
  }
  description.is_kinematic = body.is_kinematic;
  for (const Keyframe& keyframe : body.keyframes) {
    if (body.in_group) requireNear(body, keyframe.X_WB.position);
    description.keyframes.push_back({keyframe.time_s, keyframe.X_WB * X_SB});
  }
  description.interpolation = body.interpolation;
  description.repeats = body.path_repeats;
  description.locks = body.locks;
  description.load = body.load;
}

/// What a surface or a pattern is made of has a colour by itself.
void setNaturalColor(SurfaceLook& look) {
  if (look.checker && look.pattern != renderer::GroundPattern::kChecker)
    look.color = renderer::naturalColor(look.pattern);
  else if (!look.checker && look.surface != renderer::SurfaceKind::kPlain)
    look.color = renderer::naturalColor(look.surface);
}

/// The pattern's place is the body's name's, so that it stays where it is when others come or go.
renderer::Surface surfaceOf(const SurfaceLook& look, const Solid& solid, const std::string& name) {
  if (look.surface == renderer::SurfaceKind::kPlain) return {};
  Vec3 sides = 2.0 * renderer::solidExtent(solid).half;
  std::sort(sides.begin(), sides.end());
  const double scale_m = look.surface_scale_m.value_or(renderer::usualScale(sides[1]));
  return {look.surface, scale_m, static_cast<std::uint32_t>(ContentHash().add(name).value())};
}

/// The number of the solid that is drawn for the body.
int addLook(const Body& body, int solid, SceneMeshes& meshes, SceneWorld& made) {
  if (!body.visual) return solid;
  MeshReport report;
  const Solid& shape = made.world.solids()[static_cast<std::size_t>(solid)];
  made.looking_otherwise.push_back(shape.shownAs(visualSurface(*body.visual, meshes, report)));
  made.meshes.emplace_back(body.name, std::move(report));
  return -static_cast<int>(made.looking_otherwise.size());  // Not yet behind the world's.
}

/// All solids are known: those that are drawn otherwise come behind the world's own.
void numberLooks(SceneWorld& made) {
  if (made.looking_otherwise.empty()) {
    made.drawn_as.clear();
    return;
  }
  std::vector<Solid> all(made.world.solids().begin(), made.world.solids().end());
  for (int& number : made.drawn_as)
    if (number < 0) number = static_cast<int>(all.size()) - 1 - number;
  for (Solid& solid : made.looking_otherwise) all.push_back(std::move(solid));
  made.looking_otherwise = std::move(all);
}

void addBodies(SceneWorld& made, const Scene& scene, std::size_t index, const Mesh& mesh,
               SceneMeshes& meshes) {
  const Body& body = scene.bodies[index];
  std::vector<MeshReport> reports;
  const int solid = made.world.addSolid(makeSolid(body.shape, mesh, meshes, reports));
  for (MeshReport& report : reports) made.meshes.emplace_back(body.name, std::move(report));
  const int drawn = addLook(body, solid, meshes, made);
  const BoundingSurface& look = drawn < 0 ? made.looking_otherwise.back().surface()
                                          : made.world.solids()[static_cast<std::size_t>(solid)].surface();
  const bool has_look = !look.colors.empty() || !look.pictures.empty();
  const Pose X_SB{Quat::Identity(), -made.world.solids()[static_cast<std::size_t>(solid)].origin_B()};
  for (int copy = 0; copy < body.repeat.total(); ++copy) {
    BodyDescription description;
    description.solid = solid;
    const Pose X_WS = poseOfCopy(body, scene.seed, index, copy);
    if (body.in_group) requireNear(body, X_WS.position);
    description.X_WB = X_WS * X_SB;
    description.linear_velocity = body.linear_velocity;
    description.angular_velocity = body.angular_velocity;
    description.material = body.material;
    description.is_static = body.is_static;
    setMotion(body, made.world.solids()[static_cast<std::size_t>(solid)], X_SB, description);
    made.world.addBody(description);
    made.names.push_back(nameOfCopy(body, copy));
    made.looks.push_back(body.look);
    if (!body.look.has_color && !body.is_static && !body.look.checker)
      made.looks.back().color = paletteColor(made.looks.size() - 1);
    if (!body.look.has_color) setNaturalColor(made.looks.back());
    // What a mesh's colours are multiplied by, unless the scene says otherwise.
    if (!body.look.has_color && has_look) made.looks.back().color = {1.0f, 1.0f, 1.0f};
    made.drawn_as.push_back(drawn);
    if (!body.colors.empty())
      made.looks.back().color = body.colors[static_cast<std::size_t>(copy) % body.colors.size()];
  }
}

// Whether one of the two may not move along some axes.
bool onRails(const SceneWorld& made, const Overlap& pair) {
  const auto isLocked = [&](int body) {
    return made.world.bodies()[static_cast<std::size_t>(body)].locks.free_axes != Vec3::Ones();
  };
  return isLocked(pair.body_a) || isLocked(pair.body_b);
}

// What two bodies do, by how much and where.
std::string describeOverlap(const SceneWorld& made, const Overlap& pair, const char* when) {
  std::ostringstream text;
  text << "\"" << made.names[static_cast<std::size_t>(pair.body_a)] << "\" and \""
       << made.names[static_cast<std::size_t>(pair.body_b)] << "\" ";
  if (pair.depth_m > 0.0)
    text << "overlap" << when << " by " << pair.depth_m << " m";
  else
    text << "touch" << when << " and have no room to part" << (onRails(made, pair) ? " along free axes" : "");
  const auto nanometres = [](double x) { return std::round(x * 1e9) * 1e-9 + 0.0; };  // and no -0
  text << " at (" << nanometres(pair.p_W.x()) << ", " << nanometres(pair.p_W.y()) << ", "
       << nanometres(pair.p_W.z()) << ")";
  return text.str();
}

void requireFewParts(const SceneWorld& made, const Scene& scene) {
  std::size_t parts = 0;
  for (const BodyDescription& body : made.world.bodies())
    parts += made.world.solids()[static_cast<std::size_t>(body.solid)].parts().size();
  if (parts > kMostParts)
    throw InputError(scene.file.string() + ": the bodies have " + std::to_string(parts) +
                     " convex parts; accepted: at most " + std::to_string(kMostParts));
}

/// The overlaps of the world as it starts.
std::vector<Overlap> startedWith(SceneWorld& made, const Scene& scene) {
  try {
    return made.world.start();
  } catch (const TooManyPairs& error) {
    throw InputError(scene.file.string() + ": " + error.what());
  }
}

[[noreturn]] void refuseOverlaps(const SceneWorld& made, const Scene& scene,
                                 const std::vector<Overlap>& overlaps) {
  std::ostringstream message;
  message << scene.file.string() << ": " << describeOverlap(made, overlaps.front(), " at the start");
  if (overlaps.size() > 1)
    message << " (the deepest of " << overlaps.size() << " pairs; carom check lists them all)";
  // Those that only touch have no room to be moved apart by the rest gap.
  message << "; accepted: apart";
  if (overlaps.front().depth_m > 0.0)
    message << ", or just touching";
  else if (onRails(made, overlaps.front()))
    message << ", or an axis not locked that parts them";
  std::vector<std::string> pairs;
  for (const Overlap& pair : overlaps) pairs.push_back(describeOverlap(made, pair, ""));
  throw OverlapsAtStart(message.str(), std::move(pairs));
}

/// The file, and those that it names for its looks.
void addMeshFile(ContentHash& hash, const std::filesystem::path& file) {
  hash.add(readTextFile(file));
  for (const std::filesystem::path& other : filesNamedBy(file)) hash.add(readTextFile(other));
}

void addMeshFiles(ContentHash& hash, const Shape& shape, const Mesh& mesh) {
  if (const auto* hull = std::get_if<HullShape>(&shape.form)) {
    if (!hull->file.empty()) addMeshFile(hash, hull->replaceable && mesh ? *mesh : hull->file);
    if (hull->told_hull) hash.add("hull");
  } else if (const auto* compound = std::get_if<CompoundShape>(&shape.form)) {
    for (const CompoundPart& part : compound->parts) addMeshFiles(hash, part.shape, mesh);
  }
}

}  // namespace

double SceneWorld::drawnRadius(std::size_t body) const {
  const Solid& solid = drawn(body);
  if (!looksOtherwise(body)) return solid.radius();
  double radius = 0.0;
  for (const Vec3& p_B : solid.surface().mesh.vertices) radius = std::max(radius, p_B.norm());
  return radius;
}

SceneWorld makeSceneWorld(const Scene& scene, const Mesh& mesh, int threads) {
  if (mesh) requireReplaceableHull(scene);
  WorldSettings settings;
  settings.step_s = 1.0 / scene.rate_hz;
  settings.gravity = scene.gravity;
  settings.air = scene.air;
  settings.threads = threads;
  for (const NamedFluid& named : scene.fluids) settings.fluids.push_back(named.fluid);
  SceneWorld made{World(settings), {}, {}, {}, {}};
  SceneMeshes meshes;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) addBodies(made, scene, i, mesh, meshes);
  numberLooks(made);
  for (std::size_t i = 0; i < made.names.size(); ++i)
    made.surfaces.push_back(surfaceOf(made.looks[i], made.drawn(i), made.names[i]));
  requireFewParts(made, scene);
  const std::vector<Overlap> overlaps = startedWith(made, scene);
  if (!overlaps.empty()) refuseOverlaps(made, scene, overlaps);
  made.movedPoints = [scene, mesh, threads] { return pointsOfTheRun(scene, mesh, threads); };
  return made;
}

std::vector<renderer::Instance> drawnInstances(const SceneWorld& scene, std::span<const BodyState> states) {
  std::vector<renderer::Instance> instances;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const SurfaceLook& look = scene.looks[i];
    instances.push_back(
        {scene.drawnSolid(i), states[i].X_WB, look.color, look.checker, look.pattern, scene.surfaces[i]});
  }
  return instances;
}

std::uint64_t sceneHash(const Scene& scene, const Mesh& mesh) {
  ContentHash hash;
  hash.add(readTextFile(scene.file));
  for (const std::filesystem::path& file : scene.included) hash.add(readTextFile(file));
  for (const std::string& setting : scene.settings) hash.add(setting);
  for (const Body& body : scene.bodies) {
    addMeshFiles(hash, body.shape, mesh);
    if (body.visual) addMeshFile(hash, body.visual->file);
  }
  hash.add(std::to_string(scene.seed));
  return hash.value();
}

}  // namespace carom::demos
