#pragma once
// A scene as a person describes it: plain values in SI units, already checked, nothing resolved into solids
// yet. scene_file.h reads it, scene_world.h makes a world of it. Every part remembers its place in the file
// for messages.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "demos/formula/caption_text.h"
#include "demos/scene/scene_camera.h"
#include "demos/scene/scene_light.h"
#include "engine/foundation/frames.h"
#include "engine/simulation/world.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {

// What a scene may hold, so that all that is reckoned with it stays far from the ends of a double (1e-308 to
// 1e308), and every length far from the rounding of the places. A hull is at least 1e-7 of its size wide and
// thick, so volumes are 1e-26 to 1e15 m^3 and, with the densities, masses 1e-32 to 1e21 kg and moments of
// inertia 1e-54 to 1e31 kg m^2. The farthest that arithmetic takes them are the square of a determinant of
// three moments, of which two are those across the length (1e-268 to 1e186), and its inverse.
inline constexpr double kSmallestLength_m = 1e-4;
inline constexpr double kLargestLength_m = 1e5;
inline constexpr double kSmallestDensity_kgpm3 = 1e-6;
inline constexpr double kLargestDensity_kgpm3 = 1e6;
inline constexpr int kMostBodies = 20000;
inline constexpr int kMostParts = 200000;  ///< Convex parts of all bodies.
inline constexpr int kMostSeed = 1000000000;

/// "file:line: json.path" of a value.
using Place = std::string;

struct BoxShape {
  Vec3 size_m = Vec3::Ones();
};
struct SphereShape {
  double radius_m = 0.5;
};
/// Along z; `length_m` is the distance between the centres of the caps.
struct CapsuleShape {
  double radius_m = 0.5;
  double length_m = 1.0;
};
/// The convex hull of points, or a mesh file: as it is, or the hull of each of its meshes.
struct HullShape {
  std::filesystem::path file;  ///< Empty when `points` are given.
  std::vector<Vec3> points;
  double scale = 1.0;
  std::optional<double> fit_m;  ///< Scaled so that the longest side is this, and centred on its bounding box.
  bool replaceable = false;     ///< The mesh of the command line (--mesh) takes the place of `file`.
  bool as_hull = true;          ///< Of a file: its meshes' hulls instead of what they are.
  bool told_hull = false;       ///< The command line said so, not the scene.
  std::optional<bool> y_up;     ///< Of a file: whether y is up in it; not given: what its format says.
};
/// A box of this size over all whose edges and corners are rounded.
struct RoundedBoxShape {
  Vec3 size_m = Vec3::Ones();
  double radius_m = 0.1;
};
struct CompoundPart;
struct CompoundShape {
  std::vector<CompoundPart> parts;
};

struct Shape {
  std::variant<BoxShape, SphereShape, CapsuleShape, HullShape, RoundedBoxShape, CompoundShape> form;
  Place place;
};
struct CompoundPart {
  Shape shape;
  Pose X_SP;  ///< Part frame in the frame of the compound shape.
};

/// A mesh file that is drawn in place of a body's shape; nothing else follows from it.
struct Visual {
  std::filesystem::path file;
  double scale = 1.0;
  std::optional<double> fit_m;
  std::optional<bool> y_up;
  Pose X_SV;  ///< The mesh's frame in that of the shape.
  Place place;
};

struct SurfaceLook {
  renderer::Color color;
  bool checker = false;                                                 ///< It is a ground with a pattern.
  renderer::GroundPattern pattern = renderer::GroundPattern::kChecker;  ///< That of a ground.
  renderer::SurfaceKind surface = renderer::SurfaceKind::kPlain;
  std::optional<double> surface_scale_m;  ///< None: what suits the body's size.
  bool has_color = false;  ///< Given by the scene; else a body that moves takes one of the palette.
  std::string material;    ///< Its name in the scene's file, or empty.
};

/// Copies of a body on a lattice or where a pattern puts them, each turned more than the one before, and
/// moved and turned a little by the scene's random numbers.
struct Repeat {
  int count[3] = {1, 1, 1};
  Vec3 step_m = Vec3::Zero();
  std::vector<Pose> copies;  ///< Relative to the body, axes of its group; empty: the lattice.
  Vec3 turn_axis = Vec3::UnitZ();
  double turn_degrees = 0.0;    ///< Of each copy over the one before.
  double jitter_m = 0.0;        ///< Largest shift along each axis.
  double jitter_degrees = 0.0;  ///< Largest turn, about a random axis.

  int total() const {
    return copies.empty() ? count[0] * count[1] * count[2] : static_cast<int>(copies.size());
  }
};

struct Body {
  std::string name;
  Shape shape;
  std::optional<Visual> visual;
  Pose X_WS;  ///< The frame the shape is described in; in a group X_GS.
  bool in_group = false;
  Pose X_WG;  ///< Of its group.
  Vec3 linear_velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Material material;
  SurfaceLook look;
  std::vector<renderer::Color> colors;  ///< Taken in turn by the copies; empty: the look's colour.
  bool is_static = false;
  std::optional<double> mass_kg;  ///< In place of the material's density.
  bool is_kinematic = false;      ///< At its velocities for ever, or along `keyframes`, of the frame S.
  std::vector<Keyframe> keyframes;
  Interpolation interpolation = Interpolation::kLinear;
  bool path_repeats = false;
  AxisLocks locks;
  AppliedLoad load;
  Repeat repeat;
  Place place;
};

/// "crate", or "crate[7]" for the copies of a repeated body.
inline std::string nameOfCopy(const Body& body, int copy) {
  return body.repeat.total() == 1 ? body.name : body.name + "[" + std::to_string(copy) + "]";
}

/// A body of water with its name in the scene's file; `fluid` is what the engine takes. The surface over (x,
/// y) at time t is surfaceAt(fluid, gravity's magnitude, {x, y}, t).
struct NamedFluid {
  std::string name;
  Fluid fluid;
  renderer::Color color = renderer::WaterVolume{}.color;
  Place place;
};

struct Scene {
  std::string name;  ///< The file's name without its ending.
  std::filesystem::path file;
  std::string description;
  std::string look_for;  ///< What is worth a look, and the closed form where there is one; may be empty.
  std::string group;     ///< Under which a gallery lists it; may be empty.
  CaptionText caption;   ///< Drawn over the frames, unless empty.
  Vec3 gravity = Vec3(0.0, 0.0, -9.81);
  double rate_hz = 240.0;  ///< Steps a second.
  std::uint64_t seed = 1;
  double duration_s = 5.0;
  double written_duration_s = 5.0;  ///< The file's, whatever was asked for: the run that cameras frame.
  Air air;
  std::vector<NamedFluid> fluids;
  std::vector<Body> bodies;
  std::map<std::string, SceneCamera> cameras;
  SceneLight light;
  std::vector<std::filesystem::path> included;  ///< Files whose parts are in it.
  std::vector<std::string> settings;            ///< "path=value" of the command line.
  std::vector<std::string> warnings;            ///< What is written and has no effect, with its place.
};

}  // namespace carom::demos
