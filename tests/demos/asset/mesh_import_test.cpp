#include "demos/asset/mesh_import.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/asset/mesh_solid.h"
#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

double ringArea(int sides, double radius) {
  return 0.5 * sides * radius * radius * std::sin(2.0 * std::numbers::pi / sides);
}

/// A frustum between two similar, parallel polygons.
double frustum(double area_a, double area_b, double height) {
  return height / 3.0 * (area_a + area_b + std::sqrt(area_a * area_b));
}

struct ShippedMesh {
  const char* file;
  double volume;
  int parts;
};
void PrintTo(const ShippedMesh& mesh, std::ostream* out) {
  *out << mesh.file;
}

std::filesystem::path shipped(const std::string& name) {
  return std::filesystem::path(CAROM_SOURCE_DIR) / "assets/meshes" / name;
}

/// By the divergence theorem, of the tetrahedra between the origin and the triangles of an OBJ file's faces.
double surfaceVolume(const std::string& name) {
  std::ifstream in(shipped(name));
  std::vector<Vec3> points;
  double volume = 0.0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vec3 p;
      words >> p.x() >> p.y() >> p.z();
      points.push_back(p);
    } else if (kind == "f") {
      std::vector<Vec3> corners;
      for (std::size_t index; words >> index;) corners.push_back(points.at(index - 1));
      for (std::size_t i = 2; i < corners.size(); ++i)
        volume += corners[0].dot(corners[i - 1].cross(corners[i])) / 6.0;
    }
  }
  return volume;
}

const double kRootFive = std::sqrt(5.0);
const ShippedMesh kShipped[] = {
    {"gem.obj",
     frustum(ringArea(8, 0.34), ringArea(8, 0.55), 0.19) + 0.06 * ringArea(8, 0.55) +
         0.5 * ringArea(8, 0.55) / 3.0,
     1},
    {"hammer.obj", 1.2 * 0.14 * 0.14 + 0.3 * 0.7 * 0.3, 2},
    {"wedge.stl", 0.5 * 1.0 * 0.5 * 0.6, 1},
    {"pyramid.stl", 0.8 / 3.0, 1},
    {"dodecahedron.ply", (15.0 + 7.0 * kRootFive) / 4.0 * std::pow(0.36, 3), 1},
    {"prism.ply", 0.6 * ringArea(6, 0.45), 1},
    {"icosahedron.off", 5.0 * (3.0 + kRootFive) / 12.0 * std::pow(0.55, 3), 1},
    {"dumbbell.gltf", 0.8 * ringArea(8, 0.09) + 2.0 * 0.7 * 0.7 * 0.5 * 0.4 * ringArea(10, 0.5), 3},
    {"disc.obj", 0.1 * ringArea(64, 1.0), 1},
    {"bowl.obj", surfaceVolume("bowl.obj"), 268},
    {"cup.obj", surfaceVolume("cup.obj"), 48},
    {"funnel.obj", surfaceVolume("funnel.obj"), 64},
    {"gear-18.obj", surfaceVolume("gear-18.obj"), 19},
    {"gear-27.obj", surfaceVolume("gear-27.obj"), 28},
    {"link.obj", surfaceVolume("link.obj"), 12},
    {"ring.obj", surfaceVolume("ring.obj"), 16},
    {"fine-ring.obj", surfaceVolume("fine-ring.obj"), 40},
    {"drum.obj", surfaceVolume("drum.obj"), 144},
    {"bolt.obj", surfaceVolume("bolt.obj"), 99},
    {"nut.obj", surfaceVolume("nut.obj"), 144},
    {"lock-bolt.obj", surfaceVolume("lock-bolt.obj"), 3},
    {"lock-plate.obj", surfaceVolume("lock-plate.obj"), 20},
};

class ShippedMeshes : public testing::TestWithParam<ShippedMesh> {};

TEST_P(ShippedMeshes, HaveTheVolumeOfTheirClosedFormOrSurface) {
  MeshSolid mesh = meshSolid(shipped(GetParam().file));
  EXPECT_EQ(static_cast<int>(mesh.parts.size()), GetParam().parts);
  EXPECT_EQ(mesh.report.left_out, 0);
  // Files and importer hold coordinates in single precision: 6e-8 each, three of them in a volume, and half
  // as much again for the difference of sizes.
  EXPECT_NEAR(Solid(std::move(mesh.parts)).volume() / GetParam().volume, 1.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedMeshes, testing::ValuesIn(kShipped),
                         [](const testing::TestParamInfo<ShippedMesh>& mesh) {
                           std::string name = mesh.param.file;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return c == '.' || c == '-'; }, '_');
                           return name;
                         });

TEST(MeshImport, EveryShippedMeshIsInTheTable) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shipped("")))
    files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, std::size(kShipped));
}

TEST(MeshImport, SinglePrecisionLeavesFacesWhole) {
  const std::pair<const char*, int> faces[] = {{"gem.obj", 25},
                                               {"dodecahedron.ply", 12},
                                               {"prism.ply", 8},
                                               {"icosahedron.off", 20},
                                               {"pyramid.stl", 5}};
  for (const auto& [file, count] : faces)
    EXPECT_EQ(meshSolid(shipped(file)).parts[0].core.faceCount(), count) << file;
}

TEST(MeshImport, AppliesTheTransformsOfNodes) {
  const ImportedMesh mesh = importMesh(shipped("dumbbell.gltf"));
  ASSERT_EQ(mesh.parts.size(), 3u);
  double low = 0.0, high = 0.0;
  for (const auto& part : mesh.parts)
    for (const Vec3& p : part.vertices) {
      low = std::min(low, p.z());
      high = std::max(high, p.z());
    }
  // Weights of 0.4 m, scaled by a half, stand at +-0.5 m.
  EXPECT_NEAR(high, 0.6, 1e-6);
  EXPECT_NEAR(low, -0.6, 1e-6);
}

// An L that is extruded, its caps one polygon of six corners each, and named from a corner that no fan may
// begin at; the vertices are numbered as faces name them.
TEST(MeshImport, CutsPolygonsThatAreNotConvex) {
  const TemporaryFolder folder;
  const auto path = folder.file("l.obj",
                                "v 9 9 9\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
                                "v 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n"
                                "f 13 8 9 10 11 12\nf 7 6 5 4 3 2\n"
                                "f 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 7 13 12\nf 7 2 8 13\n");
  const ImportedMesh mesh = importMesh(path);
  ASSERT_EQ(mesh.parts.size(), 1u);
  const MeshPart& part = mesh.parts[0];
  ASSERT_EQ(part.vertices.size(), 12u);
  EXPECT_EQ(part.vertices[0], Vec3(0, 2, 1));
  EXPECT_EQ(part.vertices[1], Vec3(0, 0, 1));
  ASSERT_EQ(part.triangles.size(), 20u);
  double cap = 0.0;
  for (int i = 0; i < 4; ++i) {
    const auto corner = [&](std::size_t k) {
      return part.vertices[static_cast<std::size_t>(part.triangles[static_cast<std::size_t>(i)][k])];
    };
    const double area = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).z();
    EXPECT_GT(area, 0.0) << "none is turned over";
    cap += area;
  }
  EXPECT_DOUBLE_EQ(cap, 3.0);
  EXPECT_NEAR(meshSolid(path).report.volume_m3, 3.0, 1e-12);
}

TEST(MeshImport, FitsTheLongestSideAndCentres) {
  const std::vector<ConvexPart> parts = meshSolid(shipped("hammer.obj"), {.fit_m = 0.3}).parts;
  Eigen::AlignedBox3d bounds;
  for (const ConvexPart& part : parts)
    for (const Vec3& p : part.core.vertices()) bounds.extend(p);
  EXPECT_NEAR(bounds.sizes().maxCoeff(), 0.3, 1e-12);
  EXPECT_LT(bounds.center().norm(), 1e-12);
}

std::string refusal(const std::filesystem::path& path) {
  const std::string message = thrownMessage<InputError>([&path] { meshSolid(path); });
  EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0u) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return message.substr(std::min(message.size(), path.string().size() + 2));
}

TEST(MeshImport, RefusesBadFilesInOneLineWithTheReason) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal(folder.path() / "none.obj"), "no such mesh file");
  EXPECT_EQ(refusal(folder.path()), "is no file; accepted: a mesh file");
  EXPECT_EQ(refusal(folder.file("text.xyz", "hello")).rfind("cannot be read as a mesh: ", 0), 0u);
  EXPECT_EQ(refusal(folder.file("empty.obj", "")).rfind("cannot be read as a mesh: ", 0), 0u);
  EXPECT_EQ(refusal(folder.file("cut.ply", "ply\nformat ascii 1.0\nelement vertex 9\n")),
            "cannot be read as a mesh: the PLY header has no end_header");
  EXPECT_NE(refusal(folder.file("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\n")).find("open"),
            std::string::npos);
  std::string stl = readTextFile(shipped("pyramid.stl"));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(stl.data() + 84 + 12 + 8, &nan, sizeof nan);  // header, normal, x, y: the first corner's z
  EXPECT_NE(refusal(folder.file("nan.stl", stl)).find("is not finite; accepted: finite coordinates"),
            std::string::npos);
  // By what is written in the file, whoever numbers its vertices: faces name them in another order.
  const std::string numbered = refusal(folder.file(
      "nan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2.5 nan 0.25\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"));
  EXPECT_EQ(numbered.rfind("a vertex at (2.5, nan, 0.25) of mesh", 0), 0u) << numbered;
}

// assimp's reader of RAW files leaves the nodes of a file of several groups unmade: the tree has wild
// pointers.
TEST(MeshImport, AReaderThatCrashesIsABadFile) {
  const TemporaryFolder folder;
  const auto file = folder.file("wild.raw", "a\n0 0 0 1 0 0 0 1 0\nb\n0 0 0 1 0 0 0 1 0\n");
  EXPECT_EQ(refusal(file).rfind("cannot be read as a mesh: its reader crashed (", 0), 0u);
}

// By the word of the head, of a face, and by an end of the head that is none.
TEST(MeshImport, ASmallFileThatClaimsToBeLargeTakesNeitherMemoryNorTime) {
  const TemporaryFolder folder;
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(refusal(folder.file("claims.off", "OFF # many\n# comment\n1000000000 1 0\n0 0 0\n")),
            "cannot be read as a mesh: it claims 1000000000 vertices and 1 faces, but has 42 bytes");
  EXPECT_EQ(refusal(folder.file("claims.ply",
                                "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\n"
                                "end_header\n0\n")),
            "cannot be read as a mesh: it claims element vertex 4000000000, but has 77 bytes");
  EXPECT_EQ(refusal(folder.file("header.ply",
                                "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                                "end_headers\n0\n")),
            "cannot be read as a mesh: the PLY header has no end_header");
  refusal(folder.file("face.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n"));
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10));
}

TEST(MeshImport, OfHullsLeavesOutFlatMeshesBesideSolidOnes) {
  const TemporaryFolder folder;
  const auto path =
      folder.file("decal.obj",
                  "o body\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
                  "o decal\nv 0 0 2\nv 1 0 2\nv 0 1 2\nf 5 6 7\n");
  MeshSolid mesh = meshSolid(path, {.as_hull = true});
  EXPECT_EQ(mesh.report.left_out, 1);
  EXPECT_NEAR(Solid(std::move(mesh.parts)).volume(), 1.0 / 6.0, 1e-12);
}

TEST(MeshFiles, ImportAFileOnce) {
  const TemporaryFolder folder;
  const auto path = folder.file("tetrahedron.off",
                                "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                                "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  MeshFiles files;
  const ImportedMesh* const first = &files.imported(path);
  std::filesystem::remove(path);
  EXPECT_EQ(&files.imported(path), first);
  EXPECT_NEAR(meshSolid(path, {.scale = 2.0}, files).report.volume_m3, 8.0 / 6.0, 1e-12);
  EXPECT_THROW(importMesh(path), InputError);
}

}  // namespace
}  // namespace carom::demos
