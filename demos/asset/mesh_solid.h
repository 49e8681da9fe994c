#pragma once
// From a mesh file to the convex parts of a solid: each of its closed surfaces as it is, in exact convex
// pieces, or when asked for the hull of each of its meshes; and what was made of it, to be told. Tested in
// tests/demos/asset/mesh_solid_test.cpp.

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "demos/asset/mesh_import.h"
#include "demos/format/json.h"
#include "engine/solid/solid.h"

namespace carom::demos {

struct MeshRequest {
  double scale = 1.0;
  std::optional<double> fit_m =
      std::nullopt;  ///< Instead: the longest side, about the middle of the bounding box.
  std::optional<bool> y_up = std::nullopt;  ///< Whether y is up in the file; not given: what its format says.
  bool as_hull = false;
  friend auto operator<=>(const MeshRequest&, const MeshRequest&) = default;
};

struct MeshReport {
  std::string file;
  bool as_hull = false;
  int surfaces = 0;  ///< Closed ones, or the meshes whose hulls were taken.
  int pieces = 0;    ///< Convex parts in all.
  int left_out = 0;  ///< Meshes without volume, where hulls are asked for.
  int handles = 0;   ///< Holes right through.
  int cavities = 0;
  int turned = 0;   ///< Surfaces that faced inwards or both ways.
  int slivers = 0;  ///< Pieces too thin to be kept.
  double sliver_volume_m3 = 0.0;
  double volume_m3 = 0.0;
  double hull_volume_m3 = 0.0;     ///< Of the hulls of the surfaces.
  double tolerance_m = 0.0;        ///< What counted as flat.
  int pictures = 0;                ///< That it is covered with.
  int triangles = 0;               ///< Of a mesh that is only drawn; 0 of one that is a body.
  std::vector<std::string> notes;  ///< Of its looks, what is left out.
  bool y_up = false;
  double scale = 1.0;

  /// "1 surface in 20 convex pieces of 2.3 m^3 (as hulls 1.85 times that)  1 hole  y up  scale 0.01".
  std::string text() const;
  Json json() const;
};

struct MeshSolid {
  std::vector<ConvexPart> parts;
  BoundingSurface surface;  ///< Without triangles where the parts look as the file does.
  MeshReport report;
};

/// Throws InputError, with the path, for a file that cannot be read, and unless hulls are asked for for a
/// surface that is open, not manifold, goes through itself, or needs more pieces than a body may have.
MeshSolid meshSolid(const std::filesystem::path& path, const MeshRequest& request = {});
/// The same of one of several files.
MeshSolid meshSolid(const std::filesystem::path& path, const MeshRequest& request, MeshFiles& files);

/// The meshes of one scene: a file is imported once, and made a solid of once in each way that is asked for,
/// however many bodies have it.
class SceneMeshes {
 public:
  MeshFiles& files() { return files_; }
  /// As `meshSolid`.
  const MeshSolid& solid(const std::filesystem::path& path, const MeshRequest& request);

 private:
  MeshFiles files_;
  std::map<std::pair<std::filesystem::path, MeshRequest>, MeshSolid> solids_;
};

/// The file as it is drawn in place of a body, whether or not it bounds one. Throws InputError.
BoundingSurface meshLook(const std::filesystem::path& path, const MeshRequest& request, MeshFiles& files,
                         MeshReport& report);

}  // namespace carom::demos
