#include "engine/solid/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>

#include "engine/foundation/contract.h"
#include "engine/solid/planar_faces.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace carom {
namespace {

// A rounded coordinate moves the centrum of a facet, seen from its neighbour, by a few roundings.
constexpr double kRoundingsToCoplanar = 16.0;
// Thinner than this relative to its size, a point set spans no volume.
constexpr double kThin = 1e-7;
// What merges must stay well below the thinnest extent, and vertices must not wander off.
constexpr double kMostOfThickness = 1e-2;
constexpr double kMostMoved = 4.0;  // in tolerances
// A face that bends less, relative to the size, is left as it is: it bends as rounding does.
constexpr double kHarmlessBend = 0x1p-48;
// Where a tolerance makes no polyhedron, smaller ones are tried: features as fine as the tolerance call for
// no merging rather than for half of it.
constexpr double kShares[] = {1.0, 0.1, 1e-3, 1e-5};

struct Spread {
  double size = 0.0;       // distance of the two points that are farthest from each other, roughly
  double width = 0.0;      // largest distance from the line through them
  double thickness = 0.0;  // largest distance from the plane through the three
};

// How far the points reach in one, two and three dimensions, from a greedy simplex.
Spread measureSpread(std::span<const Vec3> points) {
  const auto farthest = [&](auto&& distance) {
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (const double d = distance(points[i]); d > most) {
        most = d;
        best = i;
      }
    return std::pair{points[best], most};
  };
  const auto [a, from_first] = farthest([&](const Vec3& p) { return (p - points[0]).norm(); });
  const Vec3 origin = a;
  const auto [b, size] = farthest([&](const Vec3& p) { return (p - origin).norm(); });
  if (!(size > 0.0)) return {};
  const Vec3 along = (b - origin) / size;
  const auto [c, width] = farthest([&](const Vec3& p) { return (p - origin).cross(along).norm(); });
  if (!(width > 0.0)) return {size, 0.0, 0.0};
  const Vec3 normal = along.cross(c - origin).normalized();
  const auto [d, thickness] = farthest([&](const Vec3& p) { return std::abs(dot(normal, p - origin)); });
  return {size, width, thickness};
}

Spread spreadOfSolid(std::span<const Vec3> points) {
  if (points.size() < 4)
    throw InputError("a hull needs at least 4 points, got " + std::to_string(points.size()));
  for (const Vec3& p : points)
    if (!p.allFinite()) throw InputError("a point has a coordinate that is not finite");
  const Spread spread = measureSpread(points);
  if (!(spread.size > 0.0)) throw InputError("all points coincide: no volume");
  if (!(spread.width > kThin * spread.size)) throw InputError("all points lie on one line: no volume");
  if (!(spread.thickness > kThin * spread.size))
    throw InputError("all points lie in one plane: a flat mesh has no volume");
  return spread;
}

/// The first of each set of equal points, in the order given.
std::vector<int> firstCopies(std::span<const Vec3> points) {
  const auto key = [&points](int i) {
    const Vec3& p = points[static_cast<std::size_t>(i)];
    return std::array{p.x(), p.y(), p.z()};
  };
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&key](int i, int j) { return key(i) < key(j); });
  order.erase(std::unique(order.begin(), order.end(), [&key](int i, int j) { return key(i) == key(j); }),
              order.end());
  std::sort(order.begin(), order.end());
  return order;
}

/// A face as qhull leaves it: its corners in order around it, and the points that belong to it but are no
/// vertices. Both by position in the list given to qhull.
struct Facet {
  std::vector<int> loop;
  std::vector<int> dropped;
  friend bool operator<(const Facet& x, const Facet& y) { return x.loop < y.loop; }
};

/// Owns qhull's state: freed on every way out.
class QhullRun {
 public:
  QhullRun(std::span<const Vec3> points, double tolerance_m) : sink_(std::fopen("/dev/null", "w")) {
    for (const Vec3& p : points) coordinates_.insert(coordinates_.end(), {p.x(), p.y(), p.z()});
    qh_zero(&state_, sink_);
    char options[64];  // merge what is coplanar; keep every point with the facet nearest to it
    std::snprintf(options, sizeof options, "qhull C-%.17g Qc Qi", tolerance_m);
    const int status = qh_new_qhull(&state_, 3, static_cast<int>(points.size()), coordinates_.data(), False,
                                    options, nullptr, sink_);
    if (status != 0) {
      free();
      throw InputError("no convex hull: qhull gave up with code " + std::to_string(status));
    }
  }
  ~QhullRun() { free(); }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;

  std::vector<Facet> facets() {
    std::vector<Facet> all;
    qhT* qh = &state_;  // the name qhull's iteration macros ask for
    facetT* facet;
    FORALLfacets all.push_back({loopOf(facet), pointsOf(facet->coplanarset)});
    return all;
  }

 private:
  void free() {
    qh_freeqhull(&state_, !qh_ALL);
    int curlong = 0, totlong = 0;
    qh_memfreeshort(&state_, &curlong, &totlong);
    if (sink_) std::fclose(sink_);
  }
  int idOf(vertexT* vertex) { return qh_pointid(&state_, vertex->point); }

  std::vector<int> pointsOf(setT* set) {
    std::vector<int> ids;
    pointT *point, **pointp;
    FOREACHpoint_(set) ids.push_back(qh_pointid(&state_, point));
    return ids;
  }

  /// A simplicial facet lists its three vertices; another has a ridge for each side, in no order.
  std::vector<int> loopOf(facetT* facet) {
    std::vector<std::array<int, 2>> sides;
    std::vector<int> loop;
    if (facet->simplicial) {
      vertexT *vertex, **vertexp;
      FOREACHvertex_(facet->vertices) loop.push_back(idOf(vertex));
      return loop;
    }
    ridgeT *ridge, **ridgep;
    FOREACHridge_(facet->ridges) sides.push_back(
        {idOf(SETfirstt_(ridge->vertices, vertexT)), idOf(SETsecondt_(ridge->vertices, vertexT))});
    return chained(sides);
  }

  /// The sides strung together; throws when they are not one closed ring.
  static std::vector<int> chained(const std::vector<std::array<int, 2>>& sides) {
    std::vector<std::array<int, 2>> ways = sides;  // both ways along each side, by where they begin
    for (const auto& [a, b] : sides) ways.push_back({b, a});
    std::sort(ways.begin(), ways.end());
    std::vector<int> loop{ways.front()[0]};
    int before = ways.front()[1];
    for (int here = loop[0];;) {
      const auto first = std::lower_bound(ways.begin(), ways.end(), std::array{here, -1});
      const bool two_sides = ways.end() - first >= 2 && first[0][0] == here && first[1][0] == here &&
                             (ways.end() - first == 2 || first[2][0] != here);
      if (!two_sides) throw InputError("no convex hull: a merged face is no ring of sides");
      const int next = first[0][1] == before ? first[1][1] : first[0][1];
      if (next == loop[0] || loop.size() > sides.size()) break;
      before = here;
      here = next;
      loop.push_back(here);
    }
    if (loop.size() != sides.size()) throw InputError("no convex hull: a merged face is no ring of sides");
    return loop;
  }

  std::FILE* sink_;
  std::vector<coordT> coordinates_;
  qhT state_{};
};

template <typename Points>
Vec3 areaOf(const std::vector<int>& loop, const Points& points) {
  Vec3 area = Vec3::Zero();
  const Vec3& base = points[static_cast<std::size_t>(loop[0])];
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    area += (points[static_cast<std::size_t>(loop[i])] - base)
                .cross(points[static_cast<std::size_t>(loop[i + 1])] - base);
  return area;
}

/// Numbers the corners by the order of the points, turns every loop counter-clockwise seen from outside and
/// begins it with its lowest corner, and sorts the faces. Returns the vertices.
std::vector<Vec3> orderFaces(std::vector<Facet>& facets, std::span<const Vec3> points) {
  std::vector<int> index_of(points.size(), -1);
  for (const Facet& facet : facets)
    for (int corner : facet.loop) index_of[static_cast<std::size_t>(corner)] = 0;
  std::vector<Vec3> vertices;
  Vec3 center = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (index_of[i] < 0) continue;
    index_of[i] = static_cast<int>(vertices.size());
    vertices.push_back(points[i]);
    center += points[i];
  }
  center /= static_cast<double>(vertices.size());
  for (Facet& facet : facets) {
    std::vector<int>& loop = facet.loop;
    for (int& corner : loop) corner = index_of[static_cast<std::size_t>(corner)];
    if (dot(areaOf(loop, vertices), vertices[static_cast<std::size_t>(loop[0])] - center) < 0.0)
      std::reverse(loop.begin(), loop.end());
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  }
  std::sort(facets.begin(), facets.end());
  return vertices;
}

/// How far a dropped point stands out of the face it belongs to, or of one beside that.
double farthestOutside(const ConvexPolyhedron& hull, const std::vector<Facet>& facets,
                       std::span<const Vec3> points) {
  double farthest = 0.0;
  for (int f = 0; f < hull.faceCount(); ++f)
    for (int i : facets[static_cast<std::size_t>(f)].dropped) {
      const Vec3& p = points[static_cast<std::size_t>(i)];
      farthest = std::max(farthest, hull.plane(f).signedDistance(p));
      for (int e : hull.faceEdges(f))
        farthest = std::max(farthest, hull.plane(hull.faceAcross(e, f)).signedDistance(p));
    }
  return farthest;
}

/// The hull of distinct points, all merges within `tolerance_m`; throws InputError when that is none.
Hull hullWithin(double tolerance_m, double size_m, std::span<const Vec3> points) {
  std::vector<Facet> facets = QhullRun(points, tolerance_m).facets();
  std::vector<Vec3> vertices = orderFaces(facets, points);
  std::vector<std::vector<int>> loops;
  int triangles = 0;
  for (const Facet& facet : facets) {
    loops.push_back(facet.loop);
    triangles += static_cast<int>(facet.loop.size()) - 2;
  }
  HullReport report;
  report.tolerance_m = tolerance_m;
  report.facets_merged = triangles - static_cast<int>(loops.size());
  report.interior_dropped = static_cast<int>(points.size() - vertices.size());
  if (largestBend(vertices, loops) > kHarmlessBend * size_m) {
    report.farthest_moved_m = flattenFaces(vertices, loops);
    if (report.farthest_moved_m > kMostMoved * tolerance_m)
      throw InputError("no convex hull: merged faces bend too far");
  }
  ConvexPolyhedron polyhedron = ConvexPolyhedron::fromFaces(std::move(vertices), loops);
  report.farthest_outside_m = farthestOutside(polyhedron, facets, points);
  return {std::move(polyhedron), report};
}

double coplanarTolerance(const Spread& spread, const HullSettings& settings) {
  return std::min(
      std::max(settings.coplanar_tolerance * spread.size, kRoundingsToCoplanar * settings.coordinate_error_m),
      kMostOfThickness * spread.thickness);
}

}  // namespace

Hull convexHull(std::span<const Vec3> points, const HullSettings& settings) {
  REQUIRE(settings.coplanar_tolerance >= 0.0 && settings.coordinate_error_m >= 0.0,
          settings.coplanar_tolerance, settings.coordinate_error_m);
  const Spread spread = spreadOfSolid(points);
  std::vector<Vec3> distinct;
  for (int i : firstCopies(points)) distinct.push_back(points[static_cast<std::size_t>(i)]);
  const double tolerance_m = coplanarTolerance(spread, settings);
  std::string refusal;
  for (double share : kShares) {
    try {
      Hull hull = hullWithin(share * tolerance_m, spread.size, distinct);
      hull.report.points_given = static_cast<int>(points.size());
      hull.report.duplicates_dropped = static_cast<int>(points.size() - distinct.size());
      hull.report.points_dropped = hull.report.duplicates_dropped + hull.report.interior_dropped;
      return hull;
    } catch (const InputError& error) {
      refusal = error.what();
    }
  }
  throw InputError(refusal);
}

}  // namespace carom
