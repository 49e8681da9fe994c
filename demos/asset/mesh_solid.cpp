#include "demos/asset/mesh_solid.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "demos/asset/mesh_import.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/index.h"
#include "engine/solid/convex_hull.h"
#include "engine/solid/decomposition/convex_decomposition.h"
#include "engine/solid/decomposition/surface_crossing.h"

namespace carom::demos {
namespace {

// Bodies are tested piece by piece: two of so many have a quarter of a million pairs.
constexpr int kMostPieces = 512;
// A normal that differs less from its triangle's own (a degree) makes no other picture.
constexpr double kFlatCosine = 0.9998;

/// Turns what is y-up upright: x stays, y becomes z, z becomes -y.
void turnUpright(ImportedMesh& mesh) {
  const auto turn = [](std::vector<Vec3>& vectors) {
    for (Vec3& v : vectors) v = Vec3(v.x(), -v.z(), v.y());
  };
  for (MeshPart& part : mesh.parts) {
    turn(part.vertices);
    turn(part.normals);
  }
}

double fitInto(ImportedMesh& mesh, double longest_m) {
  Eigen::AlignedBox3d bounds;
  for (const MeshPart& part : mesh.parts)
    for (const Vec3& p : part.vertices) bounds.extend(p);
  const double longest = bounds.sizes().maxCoeff();
  if (!(longest > 0.0)) throw InputError("all vertices coincide");
  const Vec3 middle = bounds.center();
  for (MeshPart& part : mesh.parts)
    for (Vec3& p : part.vertices) p = (p - middle) * (longest_m / longest);
  return longest_m / longest;
}

void addHulls(const ImportedMesh& mesh, MeshSolid& made) {
  std::string reason;
  for (const MeshPart& part : mesh.parts) {
    try {
      made.parts.push_back(
          {convexHull(part.vertices, {.coordinate_error_m = mesh.coordinate_error_m}).polyhedron, 0.0});
      ++made.report.surfaces;
    } catch (const InputError& error) {
      ++made.report.left_out;
      reason = error.what();
    }
  }
  if (made.parts.empty()) throw InputError(reason);
}

/// Of a file with pictures every part has places on them, if on none.
void fillPictures(MeshPart& part) {
  if (part.uv.empty()) part.uv.assign(part.vertices.size(), Vec2::Zero());
  if (part.picture_of.empty()) part.picture_of.assign(part.triangles.size(), -1);
}

/// Closed meshes each for itself; those that are open may be closed together, as a file's materials part
/// them.
std::vector<MeshPart> surfacesOf(const ImportedMesh& mesh) {
  std::vector<MeshPart> surfaces;
  MeshPart rest;
  const bool normals = std::none_of(mesh.parts.begin(), mesh.parts.end(),
                                    [](const MeshPart& part) { return part.normals.empty(); });
  const bool colors = std::any_of(mesh.parts.begin(), mesh.parts.end(),
                                  [](const MeshPart& part) { return !part.colors.empty(); });
  const bool pictures = !mesh.pictures.empty();
  for (MeshPart part : mesh.parts) {
    if (!normals) part.normals.clear();
    if (colors && part.colors.empty()) part.colors.assign(part.vertices.size(), Vec3::Ones());
    if (pictures) fillPictures(part);
    if (isClosed({part.vertices, part.triangles})) {
      surfaces.push_back(std::move(part));
      continue;
    }
    const int first = static_cast<int>(rest.vertices.size());
    rest.vertices.insert(rest.vertices.end(), part.vertices.begin(), part.vertices.end());
    rest.normals.insert(rest.normals.end(), part.normals.begin(), part.normals.end());
    rest.colors.insert(rest.colors.end(), part.colors.begin(), part.colors.end());
    rest.uv.insert(rest.uv.end(), part.uv.begin(), part.uv.end());
    rest.picture_of.insert(rest.picture_of.end(), part.picture_of.begin(), part.picture_of.end());
    for (const Triangle& t : part.triangles)
      rest.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  if (!rest.triangles.empty()) surfaces.push_back(std::move(rest));
  return surfaces;
}

/// Adds the surface with what the file says of its looks.
void addLooks(const MeshPart& part, const ClosedSurface& closed, BoundingSurface& surface) {
  const int first = static_cast<int>(surface.mesh.vertices.size());
  const SurfaceMesh& mesh = closed.mesh;
  surface.mesh.vertices.insert(surface.mesh.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    surface.mesh.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
    Triangle source = part.triangles[at(closed.source[t])];
    if (closed.turned[t]) std::swap(source[1], source[2]);
    const Vec3& a = mesh.vertices[at(triangle[0])];
    const Vec3 flat =
        (mesh.vertices[at(triangle[1])] - a).cross(mesh.vertices[at(triangle[2])] - a).normalized();
    Vec3 color = Vec3::Zero();
    for (const int v : source) {
      if (!part.normals.empty()) {
        const Vec3& n = part.normals[at(v)];
        surface.normals.push_back(n.dot(flat) < 0.0 ? Vec3(-n) : n);
      }
      if (!part.colors.empty()) color += part.colors[at(v)] / 3.0;
      if (!part.uv.empty()) surface.uv.push_back(part.uv[at(v)]);
    }
    if (!part.colors.empty()) surface.colors.push_back(color);
    if (!part.picture_of.empty()) surface.picture_of.push_back(part.picture_of[at(closed.source[t])]);
  }
}

/// Files of flat triangles (STL) have normals that say nothing.
bool saysNothing(const BoundingSurface& surface) {
  for (std::size_t t = 0; t < surface.mesh.triangles.size() && !surface.normals.empty(); ++t) {
    const Triangle& triangle = surface.mesh.triangles[t];
    const Vec3& a = surface.mesh.vertices[at(triangle[0])];
    const Vec3 flat = (surface.mesh.vertices[at(triangle[1])] - a)
                          .cross(surface.mesh.vertices[at(triangle[2])] - a)
                          .normalized();
    for (std::size_t k = 0; k < 3; ++k)
      if (surface.normals[3 * t + k].dot(flat) < kFlatCosine) return false;
  }
  return true;
}

void addSurface(const MeshPart& part, const ImportedMesh& file, MeshSolid& made) {
  const ClosedSurface closed = closedSurface({part.vertices, part.triangles});
  // A hull need not forgive what the file's digits bend.
  const double error_m = std::max(file.coordinate_error_m, file.written_error_m);
  MeshReport& report = made.report;
  if (const std::optional<Vec3> p = findCrossing(closed.mesh, flatTolerance(closed.mesh, error_m))) {
    std::ostringstream message;
    message << "the surface goes through itself at (" << p->x() << ", " << p->y() << ", " << p->z() << ')';
    throw InputError(message.str());
  }
  const double volume_m3 = surfaceMass(closed.mesh).mass;
  if (!(volume_m3 > 0.0)) throw InputError("the surface encloses no volume");
  const ConvexDecomposition pieces = convexDecomposition(
      closed, {.coordinate_error_m = error_m,
               .most_pieces = std::max(1, kMostPieces - static_cast<int>(made.parts.size()))});
  const bool is_convex = pieces.pieces.size() == 1 && pieces.report.cuts == 0;
  // Of what is not convex the volume alone is asked for, and faces need not be made whole.
  const HullSettings of_hull =
      is_convex ? HullSettings{.coordinate_error_m = file.coordinate_error_m} : HullSettings{};
  const ConvexPolyhedron hull = convexHull(part.vertices, of_hull).polyhedron;
  if (is_convex)
    made.parts.push_back({hull, 0.0});  // its corners in the file's order
  else
    for (const ConvexPolyhedron& piece : pieces.pieces) made.parts.push_back({piece, 0.0});
  ++report.surfaces;
  report.handles += closed.handles;
  report.cavities += closed.cavities;
  report.turned += closed.shells_turned;
  report.slivers += pieces.report.slivers;
  report.sliver_volume_m3 += pieces.report.sliver_volume_m3;
  report.tolerance_m = std::max(report.tolerance_m, pieces.report.tolerance_m);
  report.volume_m3 += volume_m3;
  report.hull_volume_m3 += polyhedronMass(hull).mass;
  addLooks(part, closed, made.surface);
}

void addSurfaces(const ImportedMesh& mesh, MeshSolid& made) {
  const std::vector<MeshPart> surfaces = surfacesOf(mesh);
  try {
    for (const MeshPart& surface : surfaces) addSurface(surface, mesh, made);
  } catch (const InputError& error) {
    throw InputError(
        std::string(error.what()) +
        "; accepted: a closed surface that bounds a solid, or \"hull\": true (--hull) for its convex hull");
  }
  if (saysNothing(made.surface)) made.surface.normals.clear();
  made.surface.pictures = mesh.pictures;
  made.report.pictures = static_cast<int>(mesh.pictures.size());
  // Polyhedra of one colour are drawn as the engine's own.
  const bool plain = made.surface.normals.empty() && made.surface.colors.empty() && made.surface.uv.empty();
  if (plain && made.parts.size() == surfaces.size())
    made.surface = {};
  else
    made.surface.of_part.assign(made.parts.size(), 1);
}

std::string counted(int count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

}  // namespace

std::string MeshReport::text() const {
  std::ostringstream line;
  if (triangles > 0)
    line << "drawn in its place: " << counted(triangles, "triangle", "triangles") << " of "
         << counted(surfaces, "mesh", "meshes");
  else if (as_hull)
    line << "the convex " << (surfaces == 1 ? "hull" : "hulls") << " of "
         << counted(surfaces, "mesh", "meshes");
  else
    line << counted(surfaces, "surface", "surfaces") << " in "
         << counted(pieces, "convex piece", "convex pieces");
  if (triangles == 0) line << " of " << volume_m3 << " m^3";
  if (!as_hull && hull_volume_m3 > volume_m3 * (1.0 + 1e-6))
    line << " (as hulls " << hull_volume_m3 / volume_m3 << " times that)";
  if (handles > 0) line << "  " << counted(handles, "hole", "holes");
  if (cavities > 0) line << "  " << counted(cavities, "cavity", "cavities");
  if (turned > 0) line << "  turned outwards: " << turned;
  if (slivers > 0) line << "  slivers left out: " << slivers << " of " << sliver_volume_m3 << " m^3";
  if (left_out > 0) line << "  left out as flat: " << left_out;
  if (pictures > 0) line << "  " << counted(pictures, "picture", "pictures");
  line << "  " << (y_up ? "y" : "z") << " up  scale " << scale;
  for (const std::string& note : notes) line << "  " << note;
  return line.str();
}

Json MeshReport::json() const {
  return Json::object({{"file", file},
                       {"hull", as_hull},
                       {"surfaces", surfaces},
                       {"pieces", pieces},
                       {"volume", volume_m3},
                       {"hullVolume", hull_volume_m3},
                       {"holes", handles},
                       {"cavities", cavities},
                       {"pictures", pictures},
                       {"drawn", triangles},
                       {"up", y_up ? "y" : "z"},
                       {"scale", scale}});
}

namespace {

/// The file upright and in its size; what was done is in the report.
ImportedMesh placedMesh(const std::filesystem::path& path, const MeshRequest& request, MeshFiles& files,
                        MeshReport& report) {
  ImportedMesh mesh = files.imported(path);
  report.file = path.filename().string();
  report.as_hull = request.as_hull;
  report.notes = mesh.notes;
  report.y_up = request.y_up.value_or(mesh.y_up);
  report.scale = request.scale;
  if (report.y_up) turnUpright(mesh);
  for (MeshPart& part : mesh.parts)
    for (Vec3& p : part.vertices) p *= request.scale;
  mesh.coordinate_error_m *= request.scale;
  mesh.written_error_m *= request.scale;
  if (!request.fit_m) return mesh;
  const double factor = fitInto(mesh, *request.fit_m);
  mesh.coordinate_error_m *= factor;
  mesh.written_error_m *= factor;
  report.scale *= factor;
  return mesh;
}

/// As it is drawn, of whatever triangles; both sides of those that bound nothing.
void addLookOf(MeshPart part, BoundingSurface& look) {
  const bool closed = isClosed({part.vertices, part.triangles});
  const std::size_t count = part.triangles.size();
  for (std::size_t t = 0; t < count && !closed; ++t) {
    const Triangle& triangle = part.triangles[t];
    part.triangles.push_back({triangle[0], triangle[2], triangle[1]});
    if (!part.picture_of.empty()) part.picture_of.push_back(part.picture_of[t]);
  }
  ClosedSurface whole;
  whole.mesh = {part.vertices, {}};
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    const Triangle& triangle = part.triangles[t];
    const Vec3& a = part.vertices[at(triangle[0])];
    if (!((part.vertices[at(triangle[1])] - a).cross(part.vertices[at(triangle[2])] - a).norm() > 0.0))
      continue;
    whole.mesh.triangles.push_back(triangle);
    whole.source.push_back(static_cast<int>(t));
    whole.turned.push_back(0);
  }
  addLooks(part, whole, look);
}

}  // namespace

MeshSolid meshSolid(const std::filesystem::path& path, const MeshRequest& request) {
  MeshFiles files;
  return meshSolid(path, request, files);
}

MeshSolid meshSolid(const std::filesystem::path& path, const MeshRequest& request, MeshFiles& files) {
  MeshSolid made;
  MeshReport& report = made.report;
  try {
    const ImportedMesh mesh = placedMesh(path, request, files, report);
    if (request.as_hull)
      addHulls(mesh, made);
    else
      addSurfaces(mesh, made);
  } catch (const InputError& error) {
    const std::string text = error.what();
    throw InputError(text.starts_with(path.string()) ? text : path.string() + ": " + text);
  }
  report.pieces = static_cast<int>(made.parts.size());
  if (request.as_hull) {
    for (const ConvexPart& part : made.parts) report.volume_m3 += polyhedronMass(part.core).mass;
    report.hull_volume_m3 = report.volume_m3;
  }
  return made;
}

const MeshSolid& SceneMeshes::solid(const std::filesystem::path& path, const MeshRequest& request) {
  const auto known = solids_.find({path, request});
  if (known != solids_.end()) return known->second;
  return solids_.emplace(std::pair(path, request), meshSolid(path, request, files_)).first->second;
}

BoundingSurface meshLook(const std::filesystem::path& path, const MeshRequest& request, MeshFiles& files,
                         MeshReport& report) {
  ImportedMesh mesh;
  try {
    mesh = placedMesh(path, request, files, report);
  } catch (const InputError& error) {
    const std::string text = error.what();
    throw InputError(text.starts_with(path.string()) ? text : path.string() + ": " + text);
  }
  BoundingSurface look;
  const bool normals = std::none_of(mesh.parts.begin(), mesh.parts.end(),
                                    [](const MeshPart& part) { return part.normals.empty(); });
  const bool colors = std::any_of(mesh.parts.begin(), mesh.parts.end(),
                                  [](const MeshPart& part) { return !part.colors.empty(); });
  for (MeshPart& part : mesh.parts) {
    if (!normals) part.normals.clear();
    if (colors && part.colors.empty()) part.colors.assign(part.vertices.size(), Vec3::Ones());
    if (!mesh.pictures.empty()) fillPictures(part);
    addLookOf(std::move(part), look);
  }
  if (look.mesh.triangles.empty()) throw InputError(path.string() + ": holds no triangle with an area");
  if (saysNothing(look)) look.normals.clear();
  look.pictures = mesh.pictures;
  report.surfaces = static_cast<int>(mesh.parts.size());
  report.pictures = static_cast<int>(mesh.pictures.size());
  report.triangles = static_cast<int>(look.mesh.triangles.size());
  return look;
}

}  // namespace carom::demos
