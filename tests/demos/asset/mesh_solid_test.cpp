#include "demos/asset/mesh_solid.h"

#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "demos/format/written_precision.h"
#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"
#include "engine/foundation/contract.h"
#include "tests/engine/solid/generated_meshes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

using namespace generated;

std::string objText(const SurfaceMesh& mesh, int from = 0, int to = -1, int digits = 9) {
  std::ostringstream text;
  text.precision(digits);
  for (const Vec3& p : mesh.vertices) text << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  const int count = static_cast<int>(mesh.triangles.size());
  for (int t = from; t < (to < 0 ? count : to); ++t) {
    const Triangle& c = mesh.triangles[static_cast<std::size_t>(t)];
    text << "f " << c[0] + 1 << ' ' << c[1] + 1 << ' ' << c[2] + 1 << '\n';
  }
  return text.str();
}

std::string refusal(const std::filesystem::path& path) {
  const std::string message = thrownMessage<InputError>([&path] { meshSolid(path); });
  EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0u) << message;
  EXPECT_NE(message.find("\"hull\": true"), std::string::npos) << message;
  return message;
}

TEST(MeshSolid, ATorusIsItselfAndNotItsHull) {
  const TemporaryFolder folder;
  const SurfaceMesh torus_mesh = torus(20, 10);
  MeshSolid made = meshSolid(folder.file("torus.obj", objText(torus_mesh)));
  const double volume = std::abs(surfaceMass(torus_mesh).mass);
  EXPECT_NEAR(made.report.volume_m3 / volume, 1.0, 1e-6);  // assimp's single precision
  EXPECT_EQ(made.report.pieces, 20);
  EXPECT_EQ(made.report.handles, 1);
  EXPECT_NEAR(made.report.hull_volume_m3 / volume, 1.544, 1e-3);
  EXPECT_NE(made.report.text().find("1 surface in 20 convex pieces"), std::string::npos)
      << made.report.text();
  EXPECT_NE(made.report.text().find("1 hole"), std::string::npos) << made.report.text();
  const Solid solid(std::move(made.parts), std::move(made.surface));
  EXPECT_NEAR(solid.volume() / volume, 1.0, 1e-6);
  EXPECT_EQ(solid.surface().mesh.triangles.size(), 400u);
}

TEST(SceneMeshes, MakeASolidOnceForEachRequest) {
  const TemporaryFolder folder;
  const auto path = folder.file("torus.obj", objText(torus(20, 10)));
  SceneMeshes meshes;
  const MeshSolid* const first = &meshes.solid(path, {});
  const MeshSolid* const twice = &meshes.solid(path, {.scale = 2.0});
  std::filesystem::remove(path);
  EXPECT_EQ(&meshes.solid(path, {}), first);
  EXPECT_EQ(&meshes.solid(path, {.scale = 2.0}), twice);
  EXPECT_NEAR(twice->report.volume_m3 / first->report.volume_m3, 8.0, 1e-9);
  EXPECT_EQ(meshes.solid(path, {.as_hull = true}).parts.size(), 1u);
}

// In the bore of a nut cuts leave pieces that hang together by an edge alone: they come apart without a cap.
TEST(MeshSolid, ThreadsOfANutAndItsBoltAreTakenExactly) {
  for (const char* const name : {"nut.obj", "bolt.obj"}) {
    const MeshSolid made = meshSolid(std::string(CAROM_SOURCE_DIR "/assets/meshes/") + name);
    double pieces_m3 = 0.0;
    for (const ConvexPart& part : made.parts) pieces_m3 += polyhedronMass(part.core).mass;
    EXPECT_NEAR(pieces_m3 / made.report.volume_m3, 1.0, 1e-12) << name;
    EXPECT_EQ(made.report.slivers, 0) << name;
    EXPECT_LE(made.report.pieces, 150) << name;
  }
}

// At some sizes rounding puts more corners on that edge: the same with triangles without area.
TEST(MeshSolid, ANutIsTakenExactlyAtAnySize) {
  for (const double scale : {0.10610755471822102, 0.7429058321918016, 0.3, 7.1}) {
    const MeshSolid made = meshSolid(CAROM_SOURCE_DIR "/assets/meshes/nut.obj", {.scale = scale});
    double pieces_m3 = 0.0;
    for (const ConvexPart& part : made.parts) pieces_m3 += polyhedronMass(part.core).mass;
    EXPECT_NEAR(pieces_m3 / made.report.volume_m3, 1.0, 1e-12) << scale;
  }
}

// As most programs write it: the faces are bent by up to a millionth.
TEST(MeshSolid, ATorusOfSixDecimalsIsNotCutAtItsRounding) {
  const TemporaryFolder folder;
  SurfaceMesh rounded = placed(torus(20, 10));
  for (Vec3& p : rounded.vertices) p = (1e6 * p).array().round().matrix() * 1e-6;
  const MeshSolid made = meshSolid(folder.file("torus.obj", objText(rounded)));
  EXPECT_EQ(made.report.pieces, 20);
  EXPECT_NEAR(made.report.volume_m3 / std::abs(surfaceMass(rounded).mass), 1.0, 1e-6);
}

TEST(MeshSolid, CoordinatesKeepTheirDigits) {
  const TemporaryFolder folder;
  const SurfaceMesh mesh = closedSurface(placed(torus(20, 10))).mesh;
  const double volume = surfaceMass(mesh).mass;
  std::ostringstream ply, off, stl;
  for (std::ostringstream* text : {&ply, &off, &stl}) text->precision(17);
  ply << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
      << "\nproperty double y\nproperty double x\nproperty double z\nelement face " << mesh.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  off << "OFF\n# by hand\n" << mesh.vertices.size() << ' ' << mesh.triangles.size() << " 0\n";
  stl << "solid ring\n";
  for (const Vec3& p : mesh.vertices) {
    ply << p.y() << ' ' << p.x() << ' ' << p.z() << '\n';
    off << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  for (const Triangle& t : mesh.triangles) {
    for (std::ostringstream* text : {&ply, &off}) *text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    stl << "facet normal 0 0 0\nouter loop\n";
    for (const int v : t) stl << "vertex " << mesh.vertices[static_cast<std::size_t>(v)].transpose() << '\n';
    stl << "endloop\nendfacet\n";
  }
  stl << "endsolid ring\n";
  for (const auto& file :
       {folder.file("ring.obj", objText(mesh, 0, -1, 17)), folder.file("ring.ply", ply.str()),
        folder.file("ring.off", off.str()), folder.file("ring.stl", stl.str())}) {
    const MeshSolid made = meshSolid(file);
    EXPECT_NEAR(made.report.volume_m3 / volume, 1.0, 1e-14) << file;
    EXPECT_EQ(made.report.pieces, 20) << file;
    EXPECT_LT(made.report.tolerance_m, 1e-13) << file;
  }
}

TEST(WrittenPrecision, IsHalfOfTheLastDigitThatIsCutOff) {
  EXPECT_EQ(halfLastDigit("v 0.5 1 -0.25\n"), 0.0);
  EXPECT_DOUBLE_EQ(halfLastDigit("v 0.500000 1.234567 -0.25\n"), 0.5e-6);
  EXPECT_DOUBLE_EQ(halfLastDigit("v 12.3457 0.123457 3\n"), 0.5e-4);
  EXPECT_DOUBLE_EQ(halfLastDigit("vertex 1.23457e-3 +2.34561e2 0\n"), 0.5e-3);
  EXPECT_EQ(halfLastDigit(std::string_view("v 0.123456\0", 11)), 0.0);
}

TEST(MeshSolid, TakesAHullOnlyWhenAskedForAndSaysSo) {
  const TemporaryFolder folder;
  const MeshSolid made = meshSolid(folder.file("torus.obj", objText(torus(20, 10))), {.as_hull = true});
  EXPECT_EQ(made.parts.size(), 1u);
  EXPECT_TRUE(made.surface.mesh.triangles.empty());
  EXPECT_EQ(made.report.text().rfind("the convex hull of 1 mesh", 0), 0u) << made.report.text();
}

TEST(MeshSolid, SaysWhereASurfaceIsNoSolid) {
  const TemporaryFolder folder;
  const SurfaceMesh cube = cells({1, 1, 1}, [](int, int, int) { return true; });
  EXPECT_NE(refusal(folder.file("open.obj", objText(cube, 1))).find("the surface is open: 3 edges"),
            std::string::npos);
  const SurfaceMesh touching = cells({2, 2, 1}, [](int x, int y, int) { return x == y; });
  EXPECT_NE(refusal(folder.file("touching.obj", objText(touching))).find("not manifold: 1 edge"),
            std::string::npos);
  const SurfaceMesh crossing = joined(cube, cube, false, 1.0, Vec3(0.5, 0.25, 0.25));
  EXPECT_NE(refusal(folder.file("crossing.obj", objText(crossing))).find("goes through itself at ("),
            std::string::npos);
}

// A bowl has at least as many pieces as faces within: 560.
TEST(MeshSolid, SaysThatAMeshNeedsTooManyPieces) {
  const TemporaryFolder folder;
  const std::string message = refusal(folder.file("scan.obj", objText(bowl(40, 14))));
  EXPECT_NE(message.find("concave edges and needs more than 512 convex pieces"), std::string::npos)
      << message;
}

// Materials part a surface into meshes that are open each for itself.
TEST(MeshSolid, MeshesThatAreClosedTogetherAreOneSurface) {
  const TemporaryFolder folder;
  const SurfaceMesh cup_mesh = cup(8);
  const std::string all = objText(cup_mesh);
  const std::size_t middle = all.find("\nf ", all.size() / 2 + all.size() / 4) + 1;
  const MeshSolid made =
      meshSolid(folder.file("cup.obj", all.substr(0, middle) + "usemtl other\n" + all.substr(middle)));
  EXPECT_EQ(made.report.surfaces, 1);
  EXPECT_EQ(made.report.pieces, 9);
}

TEST(MeshSolid, AMeshInASceneHasItsPlaceAmongTheShapes) {
  const TemporaryFolder folder;
  folder.file("torus.obj", objText(torus(20, 10)));
  const auto file = folder.file("s.json", R"({ "format": 1, "bodies": [
    { "name": "ring", "shape": { "mesh": { "file": "torus.obj", "up": "y" } }, "position": [0, 0, 3] },
    { "name": "lump", "shape": { "mesh": { "file": "torus.obj", "hull": true, "scale": 0.5 } } },
    { "name": "both", "shape": { "compound": [ { "shape": { "mesh": { "file": "torus.obj" } } },
        { "shape": { "sphere": { "radius": 0.2 } } } ] }, "position": [0, 0, 6] } ] })");
  const SceneWorld made = makeSceneWorld(readSceneFile(file), std::nullopt);
  ASSERT_EQ(made.meshes.size(), 3u);
  EXPECT_TRUE(made.meshes[0].second.y_up);
  EXPECT_FALSE(made.meshes[0].second.as_hull);
  EXPECT_TRUE(made.meshes[1].second.as_hull);
  const Solid& ring = made.world.solids()[0];
  double low = 0.0, wide = 0.0;
  for (const ConvexPart& part : ring.parts())
    for (const Vec3& p : part.core.vertices()) {
      low = std::min(low, p.z());
      wide = std::max(wide, p.y());
    }
  EXPECT_LT(low, -1.2);  // its axis was z, and is y
  EXPECT_LT(wide, 0.4);
  const Solid& both = made.world.solids()[2];
  EXPECT_EQ(both.parts().size(), 21u);
  EXPECT_TRUE(both.isPiece(0));
  EXPECT_FALSE(both.isPiece(20));
  const double ball = 4.0 / 3.0 * std::numbers::pi * 0.008;
  EXPECT_NEAR(both.volume(), ring.volume() + ball, 1e-9);
}

TEST(MeshSolid, HasTheColoursOfItsMaterialsAndTheNormalsOfItsFile) {
  const TemporaryFolder folder;
  folder.file("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const SurfaceMesh mesh = closedSurface(torus(12, 8)).mesh;
  std::string text = "mtllib two.mtl\n" + objText(mesh, 0, 0);
  for (const Vec3& p : mesh.vertices) {
    const Vec3 n = (p - Vec3(p.x(), p.y(), 0.0).normalized()).normalized();
    text += "vn " + std::to_string(n.x()) + ' ' + std::to_string(n.y()) + ' ' + std::to_string(n.z()) + '\n';
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t == 0) text += "usemtl red\n";
    if (2 * t == mesh.triangles.size()) text += "usemtl blue\n";
    text += "f";
    for (const int v : mesh.triangles[t]) text += ' ' + std::to_string(v + 1) + "//" + std::to_string(v + 1);
    text += '\n';
  }
  folder.file("two.obj", text);
  const auto file = folder.file("s.json", R"({ "format": 1, "bodies": [
    { "name": "own", "shape": { "mesh": { "file": "two.obj" } } },
    { "name": "tinted", "shape": { "mesh": { "file": "two.obj" } }, "position": [5, 0, 0], "color": "#ff0000" } ] })");
  const SceneWorld made = makeSceneWorld(readSceneFile(file), std::nullopt);
  const BoundingSurface& surface = made.world.solids()[0].surface();
  ASSERT_EQ(surface.colors.size(), mesh.triangles.size());
  ASSERT_EQ(surface.normals.size(), 3 * mesh.triangles.size());
  int red = 0, blue = 0;
  for (std::size_t t = 0; t < surface.colors.size(); ++t) {
    red += (surface.colors[t] - Vec3::UnitX()).norm() < 1e-6;
    blue += (surface.colors[t] - Vec3::UnitZ()).norm() < 1e-6;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(surface.mesh.triangles[t][k])];
      EXPECT_LT(((p - Vec3(p.x(), p.y(), 0.0).normalized()).normalized() - surface.normals[3 * t + k]).norm(),
                1e-5);
    }
  }
  EXPECT_EQ(red, static_cast<int>(mesh.triangles.size() / 2));
  EXPECT_EQ(blue, red);
  EXPECT_EQ(made.looks[0].color.g, 1.0f);
  EXPECT_EQ(made.looks[1].color.g, 0.0f);
}

// What counts is that the ball lies where the hull would have been solid.
TEST(MeshSolid, ABallFallsIntoABowlAndThroughARing) {
  const TemporaryFolder folder;
  folder.file("bowl.obj", objText(bowl(16, 4)));
  folder.file("torus.obj", objText(torus(20, 10)));
  const auto file = folder.file("s.json", R"({ "format": 1, "bodies": [
    { "name": "bowl", "shape": { "mesh": { "file": "bowl.obj" } }, "static": true },
    { "name": "ball", "shape": { "sphere": { "radius": 0.2 } }, "position": [0.3, 0, 0.3] },
    { "name": "ring", "shape": { "mesh": { "file": "torus.obj" } }, "static": true, "position": [5, 0, 0] },
    { "name": "bullet", "shape": { "sphere": { "radius": 0.2 } }, "position": [5, 0, 0.8] } ] })");
  SceneWorld made = makeSceneWorld(readSceneFile(file), std::nullopt);
  const double middle = -0.5;  // well below the bowl's rim and the ring's
  for (int step = 0; step < 240; ++step) made.world.step();
  const auto height = [&](std::size_t body) { return made.world.states()[body].X_WB.position.z(); };
  EXPECT_LT(height(1), middle);
  EXPECT_GT(height(1), -1.0);
  EXPECT_LT(height(3), -2.0);
}

}  // namespace
}  // namespace carom::demos
