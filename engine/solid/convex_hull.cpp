#include "engine/solid/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

#include "engine/foundation/contract.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace carom {
namespace {

// Facets whose centrum lies within this distance of a neighbour's plane (relative to the size) become one
// face: above the rounding of double input, below what a distance is asked to be right to.
constexpr double kCoplanar = 1e-11;
// Thinner than this relative to its size, a point set spans no volume.
constexpr double kFlat = 1e-7;

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
  const auto [d, thickness] = farthest([&](const Vec3& p) { return std::abs(normal.dot(p - origin)); });
  return {size, width, thickness};
}

void refuseFlat(std::span<const Vec3> points) {
  if (points.size() < 4)
    throw InputError("a hull needs at least 4 points, got " + std::to_string(points.size()));
  for (const Vec3& p : points)
    if (!p.allFinite()) throw InputError("a point has a coordinate that is not finite");
  const Spread spread = measureSpread(points);
  if (!(spread.size > 0.0)) throw InputError("all points coincide: no volume");
  if (!(spread.width > kFlat * spread.size)) throw InputError("all points lie on one line: no volume");
  if (!(spread.thickness > kFlat * spread.size))
    throw InputError("all points lie in one plane: a flat mesh has no volume");
}

// Owns qhull's state: freed on every way out.
class QhullRun {
 public:
  QhullRun(std::span<const Vec3> points, double size) : sink_(std::fopen("/dev/null", "w")) {
    for (const Vec3& p : points) coordinates_.insert(coordinates_.end(), {p.x(), p.y(), p.z()});
    qh_zero(&state_, sink_);
    char options[64];
    std::snprintf(options, sizeof options, "qhull C-%.3g", kCoplanar * size);
    status_ = qh_new_qhull(&state_, 3, static_cast<int>(points.size()), coordinates_.data(), False, options,
                           nullptr, sink_);
  }
  ~QhullRun() {
    qh_freeqhull(&state_, !qh_ALL);
    int curlong = 0, totlong = 0;
    qh_memfreeshort(&state_, &curlong, &totlong);
    if (sink_) std::fclose(sink_);
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;
  int status() const { return status_; }
  qhT* state() { return &state_; }

 private:
  std::FILE* sink_;
  std::vector<coordT> coordinates_;
  qhT state_{};
  int status_ = 0;
};

}  // namespace

Hull convexHull(std::span<const Vec3> points) {
  refuseFlat(points);
  QhullRun run(points, measureSpread(points).size);
  if (run.status() != 0)
    throw InputError("no convex hull: qhull gave up with code " + std::to_string(run.status()));

  qhT* qh = run.state();  // the name qhull's iteration macros ask for
  std::vector<Vec3> vertices;
  std::vector<int> index_of(points.size(), -1);
  std::vector<std::vector<int>> loops;
  int triangles = 0;
  facetT* facet;
  FORALLfacets {
    std::vector<int> loop;
    setT* ring = qh_facet3vertex(qh, facet);
    vertexT *vertex, **vertexp;
    FOREACHvertex_(ring) {
      const int id = qh_pointid(qh, vertex->point);
      int& index = index_of[static_cast<std::size_t>(id)];
      if (index < 0) {
        index = static_cast<int>(vertices.size());
        vertices.push_back(points[static_cast<std::size_t>(id)]);
      }
      loop.push_back(index);
    }
    qh_settempfree(qh, &ring);
    triangles += static_cast<int>(loop.size()) - 2;
    loops.push_back(std::move(loop));
  }
  // qhull's ring is clockwise or counter-clockwise as its own normal says; ours is told by the centre.
  Vec3 center = Vec3::Zero();
  for (const Vec3& v : vertices) center += v;
  center /= static_cast<double>(vertices.size());
  for (std::vector<int>& loop : loops) {
    Vec3 normal = Vec3::Zero();
    const Vec3 base = vertices[static_cast<std::size_t>(loop[0])];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      normal += (vertices[static_cast<std::size_t>(loop[i])] - base)
                    .cross(vertices[static_cast<std::size_t>(loop[i + 1])] - base);
    if (normal.dot(base - center) < 0.0) std::reverse(loop.begin(), loop.end());
  }
  HullReport report;
  report.points_given = static_cast<int>(points.size());
  report.points_dropped = report.points_given - static_cast<int>(vertices.size());
  report.facets_merged = triangles - static_cast<int>(loops.size());
  return {ConvexPolyhedron::fromFaces(std::move(vertices), loops), report};
}

}  // namespace carom
