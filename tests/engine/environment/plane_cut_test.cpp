#include "engine/environment/plane_cut.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "engine/solid/solid.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using Real = long double;
using Vec3R = Eigen::Matrix<Real, 3, 1>;

struct Exact {
  Real volume = 0;
  Vec3R first = Vec3R::Zero();

  void addTetrahedron(const Vec3R& a, const Vec3R& b, const Vec3R& c, const Vec3R& d, Real sign) {
    const Real v = sign * std::abs((b - a).dot((c - a).cross(d - a))) / 6;
    volume += v;
    first += v / 4 * (a + b + c + d);
  }
};

/// A corner with its height over the plane.
struct Corner {
  Vec3R p;
  Real height;
};
Vec3R crossing(const Corner& low, const Corner& high) {
  return low.p + low.height / (low.height - high.height) * (high.p - low.p);
}

/// Independent of the code: a tetrahedron below a plane, by how many of its corners are below, in long
/// double.
void addBelow(Exact& sum, std::array<Corner, 4> t, Real sign) {
  std::sort(t.begin(), t.end(), [](const Corner& x, const Corner& y) { return x.height < y.height; });
  const auto below = std::count_if(t.begin(), t.end(), [](const Corner& c) { return c.height < 0; });
  if (below == 4) sum.addTetrahedron(t[0].p, t[1].p, t[2].p, t[3].p, sign);
  if (below == 1)
    sum.addTetrahedron(t[0].p, crossing(t[0], t[1]), crossing(t[0], t[2]), crossing(t[0], t[3]), sign);
  if (below == 3) {
    sum.addTetrahedron(t[0].p, t[1].p, t[2].p, t[3].p, sign);
    sum.addTetrahedron(t[3].p, crossing(t[0], t[3]), crossing(t[1], t[3]), crossing(t[2], t[3]), -sign);
  }
  if (below == 2) {  // a wedge: three tetrahedra
    const Vec3R a2 = crossing(t[0], t[2]), a3 = crossing(t[0], t[3]);
    const Vec3R b2 = crossing(t[1], t[2]), b3 = crossing(t[1], t[3]);
    sum.addTetrahedron(t[0].p, t[1].p, b2, b3, sign);
    sum.addTetrahedron(t[0].p, a2, b2, b3, sign);
    sum.addTetrahedron(t[0].p, a2, a3, b3, sign);
  }
}

/// Tetrahedra from the middle of the vertices to a fan of every face.
Exact exactBelow(const ConvexPolyhedron& polyhedron, const Plane& plane) {
  const auto corner = [&](const Vec3R& p) {
    return Corner{p, plane.normal.cast<Real>().dot(p) - static_cast<Real>(plane.offset)};
  };
  Vec3R middle = Vec3R::Zero();
  for (const Vec3& v : polyhedron.vertices()) middle += v.cast<Real>();
  middle /= static_cast<Real>(polyhedron.vertexCount());
  Exact sum;
  for (int f = 0; f < polyhedron.faceCount(); ++f) {
    const auto loop = polyhedron.faceVertices(f);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      addBelow(sum,
               {corner(middle), corner(polyhedron.vertex(loop[0]).cast<Real>()),
                corner(polyhedron.vertex(loop[i]).cast<Real>()),
                corner(polyhedron.vertex(loop[i + 1]).cast<Real>())},
               1);
  }
  return sum;
}

std::vector<ConvexPolyhedron> shapes(oracle::Random& random) {
  std::vector<ConvexPolyhedron> all{boxPolyhedron(Vec3(1.0, 1.0, 1.0)),
                                    boxPolyhedron(Vec3(2.0, 0.7, 0.05)),
                                    oracle::tetrahedron(),
                                    oracle::octahedron(),
                                    oracle::dodecahedron(),
                                    oracle::prism(60, 0.5, 1.0),
                                    oracle::triangulatedBox(Vec3(0.6, 0.5, 0.4))};
  for (int i = 0; i < 5; ++i) all.push_back(oracle::randomHull(random, 40, Vec3(1.0, 0.6, 0.3)));
  return all;
}

/// Through one, two or three vertices of the polyhedron, along a face, or anywhere.
Plane randomPlane(oracle::Random& random, const ConvexPolyhedron& p, int kind) {
  const auto pick = [&] {
    return p.vertex(static_cast<int>(random.uniform(0.0, 0.999999) * p.vertexCount()));
  };
  const auto direction = [&] {
    return Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0) + 1e-3);
  };
  Vec3 n = direction().normalized();
  if (kind == 0) return {n, n.dot(p.center()) + random.uniform(-1.0, 1.0) * p.radius()};
  if (kind == 1) return {n, n.dot(pick())};
  if (kind == 4) {
    const Plane& face = p.plane(static_cast<int>(random.uniform(0.0, 0.999999) * p.faceCount()));
    return random.uniform(0.0, 1.0) < 0.5 ? face : Plane{-face.normal, -face.offset};
  }
  const Vec3 a = pick(), b = pick(), c = pick();
  const Vec3 normal = kind == 2 ? Vec3((b - a).cross(direction())) : Vec3((b - a).cross(c - a));
  if (normal.norm() < 1e-3) return {n, n.dot(a)};
  n = normal.normalized();
  return {n, n.dot(a)};
}

TEST(PlaneCut, VolumeAndCentroidAgreeWithTetrahedraInLongDoubleOnAHundredThousandCuts) {
  oracle::Random random(20240611);
  const std::vector<ConvexPolyhedron> all = shapes(random);
  CutScratch scratch;
  double worst_volume = 0.0, worst_centroid = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const ConvexPolyhedron& p = all[static_cast<std::size_t>(i) % all.size()];
    const Plane plane = randomPlane(random, p, i / 12 % 5);
    const VolumeMoments cut = cutPolyhedron(p, std::span(&plane, 1), scratch, nullptr, nullptr);
    const Exact exact = exactBelow(p, plane);
    const Real whole = exactBelow(p, {plane.normal, 1e3}).volume;
    // Slices thinner than a millionth are judged against a millionth: their thickness is known to rounding.
    const Real scale = std::max(exact.volume, Real(1e-6) * whole);
    const auto volume_error =
        static_cast<double>(std::abs(static_cast<Real>(cut.volume_m3) - exact.volume) / scale);
    worst_volume = std::max(worst_volume, volume_error);
    const double bound = exact.volume > Real(1e-3) * whole ? 1e-12 : 1e-9;
    ASSERT_LE(volume_error, bound) << "cut " << i;
    if (exact.volume < Real(1e-3) * whole) continue;
    const Vec3R centroid = exact.first / exact.volume;
    const auto centroid_error =
        static_cast<double>((cut.centroid().cast<Real>() - centroid).norm() / Real(p.radius()));
    worst_centroid = std::max(worst_centroid, centroid_error);
    ASSERT_LE(centroid_error, 1e-12) << "cut " << i;
  }
  RecordProperty("worst_volume", std::to_string(worst_volume * 1e15) + "e-15");
  RecordProperty("worst_centroid", std::to_string(worst_centroid * 1e15) + "e-15");
}

TEST(PlaneCut, FacetsOnBothSidesMakeUpEveryFace) {
  oracle::Random random(7);
  const std::vector<ConvexPolyhedron> all = shapes(random);
  CutScratch scratch;
  FacetList inside, outside, whole;
  for (int i = 0; i < 2000; ++i) {
    const ConvexPolyhedron& p = all[static_cast<std::size_t>(i) % all.size()];
    const Plane planes[2] = {randomPlane(random, p, 0), randomPlane(random, p, 0)};
    inside.clear();
    outside.clear();
    whole.clear();
    cutPolyhedron(p, planes, scratch, &inside, &outside);
    cutPolyhedron(p, {}, scratch, &whole, nullptr);
    Vec3 pieces = Vec3::Zero(), faces = Vec3::Zero();  // sums of area times first moment along the normal
    const auto add = [](const FacetList& list, Vec3& sum) {
      for (const Facet& f : list.facets) {
        const PolygonArea area = areaOf(list.cornersOf(f), f.normal);
        sum += area.area_m2 * (area.centroid + f.normal);
      }
    };
    add(inside, pieces);
    add(outside, pieces);
    add(whole, faces);
    ASSERT_LT((pieces - faces).norm(), 1e-12) << i;
  }
}

TEST(PlaneCut, ACornerOfABoxCutByThreePlanesIsABox) {
  CutScratch scratch;
  const ConvexPolyhedron box = boxPolyhedron(Vec3(2.0, 3.0, 4.0));
  const Plane planes[3] = {{Vec3::UnitZ(), -0.5}, {-Vec3::UnitX(), -0.25}, {Vec3::UnitY(), 1.0}};
  const VolumeMoments cut = cutPolyhedron(box, planes, scratch, nullptr, nullptr);
  EXPECT_NEAR(cut.volume_m3, 0.75 * 2.5 * 1.5, 1e-14);
  EXPECT_LT((cut.centroid() - Vec3(0.625, -0.25, -1.25)).norm(), 1e-14);
}

TEST(PlaneCut, TwoSidesOfObliquePlanesAddUp) {
  oracle::Random random(11);
  const std::vector<ConvexPolyhedron> all = shapes(random);
  CutScratch scratch;
  for (int i = 0; i < 2000; ++i) {
    const ConvexPolyhedron& p = all[static_cast<std::size_t>(i) % all.size()];
    const Plane first = randomPlane(random, p, 0), second = randomPlane(random, p, 0);
    const Plane both[2] = {first, second}, other[2] = {first, {-second.normal, -second.offset}};
    const VolumeMoments a = cutPolyhedron(p, both, scratch, nullptr, nullptr);
    const VolumeMoments b = cutPolyhedron(p, other, scratch, nullptr, nullptr);
    const VolumeMoments sum = cutPolyhedron(p, std::span(&first, 1), scratch, nullptr, nullptr);
    ASSERT_NEAR(a.volume_m3 + b.volume_m3, sum.volume_m3, 1e-12) << i;
    ASSERT_LT((a.first_m4 + b.first_m4 - sum.first_m4).norm(), 1e-12) << i;
  }
}

}  // namespace
}  // namespace carom
