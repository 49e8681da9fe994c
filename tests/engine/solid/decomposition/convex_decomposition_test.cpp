#include "engine/solid/decomposition/convex_decomposition.h"

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "engine/foundation/index.h"
#include "engine/solid/mass_properties.h"
#include "tests/engine/solid/generated_meshes.h"
#include "tests/oracle/separating_axes.h"
#include "tests/support/thrown_message.h"

namespace carom {
namespace {

using namespace generated;

std::vector<NamedMesh> family() {
  std::vector<NamedMesh> all;
  all.push_back({"L", cells({2, 1, 2}, [](int x, int, int z) { return x == 0 || z == 0; }), 2});
  all.push_back({"cracked cube", cells({3, 1, 3}, [](int x, int, int z) { return x != 1 || z == 0; }), 3});
  all.push_back({"hole", cells({3, 1, 3}, [](int x, int, int z) { return x != 1 || z != 1; }), 4});
  all.push_back({"comb", cells({9, 2, 3}, [](int x, int, int z) { return x % 2 == 0 || z == 0; }), 7});
  all.push_back(
      {"lattice", cells({5, 5, 1}, [](int x, int y, int) { return x % 2 == 0 || y % 2 == 0; }), 12});
  all.push_back({"torus of 400", torus(20, 10), 20});
  all.push_back({"link of 440", link(20, 10), 22});
  all.push_back({"cup", cup(24), 25});
  all.push_back({"bowl", bowl(12, 4), 48});
  all.push_back({"gear", gear(12), 60});
  all.push_back({"hollow cube",
                 joined(cells({3, 3, 3}, [](int, int, int) { return true; }),
                        cells({1, 1, 1}, [](int, int, int) { return true; }), true, 1.0, Vec3(0.9, 1.1, 1.0)),
                 6});
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    all.push_back(
        {"dented ball " + std::to_string(seed), dentedBall(9, 6, 2 + static_cast<int>(seed % 4), seed), 90});
  // The same at other sizes, and far from the origin.
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) {
    NamedMesh other = all[i];
    other.name += i % 2 == 0 ? ", small" : ", large and far";
    for (Vec3& p : other.mesh.vertices)
      p = i % 2 == 0 ? Vec3(2e-3 * p) : Vec3(50.0 * p + Vec3(900.0, -70.0, 400.0));
    all.push_back(other);
  }
  for (NamedMesh& one : all) one.mesh = placed(one.mesh);
  return all;
}

/// One of many dented balls.
SurfaceMesh seededBall(std::uint64_t seed) {
  Random random(seed + 1);
  const int sides = 4 + static_cast<int>(random.unit() * 12), rows = 3 + static_cast<int>(random.unit() * 8);
  return dentedBall(sides, rows, 1 + static_cast<int>(random.unit() * 6), seed);
}

double largestCoordinate(const SurfaceMesh& mesh) {
  double largest = 0.0;
  for (const Vec3& p : mesh.vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

/// How far inside a piece the point is, at least.
double depthIn(const ConvexPolyhedron& piece, const Vec3& p) {
  double depth = std::numeric_limits<double>::infinity();
  for (int f = 0; f < piece.faceCount(); ++f) depth = std::min(depth, -piece.plane(f).signedDistance(p));
  return depth;
}

/// Whether the point is inside the surface: crossings of a ray in exact signs, unless it passes an edge too
/// near to tell; nothing then.
std::optional<bool> insideByRay(const SurfaceMesh& mesh, const Vec3& p, const Vec3& ray) {
  int crossings = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])] - p,
               b = mesh.vertices[static_cast<std::size_t>(t[1])] - p,
               c = mesh.vertices[static_cast<std::size_t>(t[2])] - p;
    const double u = ray.dot(b.cross(c)), v = ray.dot(c.cross(a)), w = ray.dot(a.cross(b));
    const double size = a.norm() + b.norm() + c.norm();
    if (std::min({std::abs(u), std::abs(v), std::abs(w)}) < 1e-13 * size * size) {
      if ((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0)) return std::nullopt;
      continue;
    }
    const bool positive = u > 0.0 && v > 0.0 && w > 0.0, negative = u < 0.0 && v < 0.0 && w < 0.0;
    if (!positive && !negative) continue;
    // The ray's parameter has the sign of the tetrahedron's volume over that of its base.
    if ((a.dot(b.cross(c)) > 0.0) == positive) ++crossings;
  }
  return crossings % 2 == 1;
}

class Family : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    mesh_ = family()[GetParam()];
    surface_ = closedSurface(mesh_.mesh);
    made_ = convexDecomposition(surface_);
  }
  NamedMesh mesh_;
  ClosedSurface surface_;
  ConvexDecomposition made_;
};

TEST_P(Family, PiecesHaveTheSolidsVolume) {
  double volume = 0.0;
  for (const ConvexPolyhedron& piece : made_.pieces) volume += polyhedronMass(piece).mass;
  const double whole = surfaceMass(surface_.mesh).mass;
  EXPECT_LE(std::abs(volume - whole), 1e-12 * whole) << mesh_.name;
  EXPECT_EQ(made_.report.slivers, 0) << mesh_.name;
  EXPECT_LE(static_cast<int>(made_.pieces.size()), mesh_.most_pieces) << mesh_.name;
}

TEST_P(Family, PiecesDoNotOverlap) {
  std::vector<oracle::PlacedConvex> placed_pieces;
  for (const ConvexPolyhedron& piece : made_.pieces)
    placed_pieces.push_back(oracle::place({piece, 0.0}, Pose{}));
  const double tolerance = 4.0 * made_.report.tolerance_m;
  for (std::size_t i = 0; i < placed_pieces.size(); ++i)
    for (std::size_t k = i + 1; k < placed_pieces.size(); ++k) {
      if ((made_.pieces[i].center() - made_.pieces[k].center()).norm() >
          made_.pieces[i].radius() + made_.pieces[k].radius())
        continue;
      EXPECT_GE(static_cast<double>(oracle::largestAxisGap(placed_pieces[i], placed_pieces[k]).gap_m),
                -tolerance)
          << mesh_.name << ": " << i << " and " << k;
    }
}

TEST_P(Family, APointIsInAPieceWhereARayFindsItInside) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : surface_.mesh.vertices) box.extend(p);
  Random random(GetParam() + 7);
  const double tolerance = 4.0 * made_.report.tolerance_m;
  int told = 0, inside_count = 0;
  for (int i = 0; i < 2500; ++i) {
    const Vec3 p = box.center() + 0.51 * box.sizes().cwiseProduct(random.inCube());
    double depth = -std::numeric_limits<double>::infinity();
    for (const ConvexPolyhedron& piece : made_.pieces) depth = std::max(depth, depthIn(piece, p));
    if (std::abs(depth) <= tolerance) continue;  // on a surface or a seam
    const std::optional<bool> inside = insideByRay(surface_.mesh, p, Vec3(0.31, 0.62, -0.72));
    if (!inside) continue;
    ++told;
    inside_count += *inside ? 1 : 0;
    ASSERT_EQ(depth > 0.0, *inside) << mesh_.name << " at " << p.transpose();
  }
  EXPECT_GT(told, 2400) << mesh_.name;
  EXPECT_GT(inside_count, 20) << mesh_.name;
}

INSTANTIATE_TEST_SUITE_P(ConvexDecomposition, Family, testing::Range(std::size_t{0}, family().size()));

TEST(ConvexDecomposition, LeavesAConvexSolidWhole) {
  const ConvexDecomposition made =
      convexDecomposition(closedSurface(cells({3, 2, 1}, [](int, int, int) { return true; })));
  ASSERT_EQ(made.pieces.size(), 1u);
  EXPECT_EQ(made.pieces[0].vertexCount(), 8);
  EXPECT_EQ(made.report.cuts, 0);
}

// Six digits bend the faces of a torus; cut at every bend it would be slivers.
TEST(ConvexDecomposition, TakesAFilesRoundingForFlat) {
  SurfaceMesh rounded = placed(torus(20, 10));
  for (Vec3& p : rounded.vertices) p = (1e6 * p).array().round().matrix() * 1e-6;
  const ClosedSurface surface = closedSurface(rounded);
  const ConvexDecomposition made = convexDecomposition(surface, {.coordinate_error_m = 0.5e-6});
  EXPECT_EQ(made.pieces.size(), 20u);
  EXPECT_NEAR(made.report.volume_m3 / surfaceMass(rounded).mass, 1.0, 1e-6);
}

double surfaceOf(const ConvexPolyhedron& piece) {
  double area = 0.0;
  for (int f = 0; f < piece.faceCount(); ++f) {
    const std::span<const int> loop = piece.faceVertices(f);
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Vec3 a = piece.vertex(loop[0]), b = piece.vertex(loop[i - 1]), c = piece.vertex(loop[i]);
      area += 0.5 * (b - a).cross(c - a).norm();
    }
  }
  return area;
}

// The volume of what is convex to a tolerance is off by that times its surface on either side.
TEST(ConvexDecomposition, OfARoundedFile_HasTheSolidsVolumeButForWhatIsFlat_FarFromTheOriginToo) {
  for (std::uint64_t seed = 4; seed <= 8; ++seed)
    for (const double far : {0.0, 1000.0}) {
      SurfaceMesh ball = placed(seededBall(seed));
      for (Vec3& p : ball.vertices) p += far * Vec3(1.0, -0.5, 0.25);
      const ConvexDecomposition made = convexDecomposition(closedSurface(ball), {.coordinate_error_m = 1e-4});
      double surface = 0.0;
      for (const ConvexPolyhedron& piece : made.pieces) surface += surfaceOf(piece);
      EXPECT_LE(std::abs(made.report.volume_m3 - surfaceMass(ball).mass),
                2.0 * made.report.tolerance_m * surface)
          << "ball " << seed << ", " << far << " m away";
    }
}

// Some cuts of this one part what another cut has made convex already.
TEST(ConvexDecomposition, PutsTogetherPiecesThatMakeAConvexOne) {
  const ClosedSurface surface = closedSurface(placed(seededBall(92)));
  const ConvexDecomposition made = convexDecomposition(surface);
  EXPECT_GT(made.report.merged, 0);
  EXPECT_NEAR(made.report.volume_m3 / surfaceMass(surface.mesh).mass, 1.0, 1e-12);
}

/// Each triangle in three, with a corner in its middle.
SurfaceMesh divided(const SurfaceMesh& mesh) {
  SurfaceMesh made{mesh.vertices, {}};
  for (const Triangle& t : mesh.triangles) {
    const int middle = static_cast<int>(made.vertices.size());
    Vec3 sum = Vec3::Zero();
    for (const int v : t) sum += mesh.vertices[at(v)];
    made.vertices.emplace_back(sum / 3.0);
    for (std::size_t k = 0; k < 3; ++k) made.triangles.push_back({t[k], t[(k + 1) % 3], middle});
  }
  return made;
}

/// A slab with a groove of 15 edges along its lower side, and a block of 14 on its upper one, two of them
/// across the groove.
SurfaceMesh blockOverGroove() {
  constexpr int kSlices = 15, kFirst = 4, kLast = 10, kBottom = 6;
  const std::vector<Vec2> outline{{2, 0},     {1, 0},    {-1, 0},   {-2, 0}, {-2, -1},
                                  {-0.2, -1}, {0, -0.6}, {0.2, -1}, {2, -1}};
  const int n = static_cast<int>(outline.size());
  SurfaceMesh mesh;
  for (int i = 0; i <= kSlices; ++i)
    for (const Vec2& p : outline) mesh.vertices.emplace_back(0.7 * i, p.x(), p.y());
  for (int i = kFirst; i <= kLast; ++i)
    for (const double y : {1.0, -1.0}) mesh.vertices.emplace_back(0.7 * i, y, 1.0);
  const auto foot = [&](int i, int side) { return n * i + 1 + side; };
  const auto top = [&](int i, int side) { return n * (kSlices + 1) + 2 * (i - kFirst) + side; };
  for (int i = 0; i < kSlices; ++i)
    for (int k = 0; k < n; ++k) {
      const bool below_block = k == 1 && i >= kFirst && i < kLast;
      if (!below_block)
        addQuad(mesh, n * i + k, n * i + (k + 1) % n, n * (i + 1) + (k + 1) % n, n * (i + 1) + k);
    }
  for (int i = kFirst; i < kLast; ++i) {
    addQuad(mesh, top(i, 0), top(i, 1), top(i + 1, 1), top(i + 1, 0));
    addQuad(mesh, foot(i, 0), top(i, 0), top(i + 1, 0), foot(i + 1, 0));
    addQuad(mesh, foot(i + 1, 1), top(i + 1, 1), top(i, 1), foot(i, 1));
  }
  addQuad(mesh, foot(kFirst, 1), top(kFirst, 1), top(kFirst, 0), foot(kFirst, 0));
  addQuad(mesh, foot(kLast, 0), top(kLast, 0), top(kLast, 1), foot(kLast, 1));
  for (int k = 0; k < n; ++k) {
    const int l = (k + 1) % n, last = n * kSlices;
    if (k == kBottom || l == kBottom) continue;
    mesh.triangles.push_back({kBottom, l, k});
    mesh.triangles.push_back({last + kBottom, last + k, last + l});
  }
  return mesh;
}

// Along the groove a cut would remove 15 notches, and leave two blocks to be cut off: below the block first
// it removes 14 and crosses none, and one cut each is enough. Of so many triangles few planes are looked at.
TEST(ConvexDecomposition, CutsFirstWhereNoNotchIsCrossed) {
  const ConvexDecomposition made =
      convexDecomposition(closedSurface(placed(divided(divided(blockOverGroove())))));
  EXPECT_EQ(made.report.notches, 29);
  EXPECT_EQ(made.report.cuts, 2);
  EXPECT_EQ(made.pieces.size(), 3u);
}

// Cuts leave a notch on a triangle thinner than rounding, which no plane divides.
TEST(ConvexDecomposition, TakesANotchThatNoPlaneDividesForNone) {
  const ClosedSurface surface = closedSurface(placed(seededBall(165)));
  EXPECT_NEAR(convexDecomposition(surface).report.volume_m3 / surfaceMass(surface.mesh).mass, 1.0, 1e-12);
}

TEST(ConvexDecomposition, RefusesWhatNeedsTooManyPieces) {
  const ClosedSurface surface = closedSurface(bowl(16, 5));  // 80 faces within, none two in one piece
  const std::string said =
      thrownMessage<InputError>([&] { convexDecomposition(surface, {.most_pieces = 40}); });
  EXPECT_NE(said.find("more than 40 convex pieces"), std::string::npos) << said;
}

TEST(ConvexDecomposition, GivesTheSameBitsAgain) {
  const ClosedSurface surface = closedSurface(placed(dentedBall(12, 8, 3, 4)));
  const ConvexDecomposition a = convexDecomposition(surface), b = convexDecomposition(surface);
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t i = 0; i < a.pieces.size(); ++i)
    EXPECT_EQ(a.pieces[i].fingerprint(), b.pieces[i].fingerprint());
}

TEST(ConvexDecomposition, LargestCoordinateDecidesWhatIsFlat) {
  const SurfaceMesh mesh = placed(torus(6, 5), 1000.0);
  const ConvexDecomposition made = convexDecomposition(closedSurface(mesh));
  EXPECT_LT(made.report.tolerance_m, 1e-14 * largestCoordinate(mesh));
}

}  // namespace
}  // namespace carom
