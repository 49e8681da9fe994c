#include "engine/solid/decomposition/convex_decomposition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "engine/foundation/contract.h"
#include "engine/foundation/index.h"
#include "engine/solid/convex_hull.h"
#include "engine/solid/decomposition/cut_surface.h"
#include "engine/solid/mass_properties.h"

namespace carom {
namespace {

// A distance from a plane is a sum of four products of numbers as large as the coordinates, of which each
// factor is rounded: at most 16 roundings; as much again for points that are themselves cuts of edges.
constexpr double kRoundings = 32.0;
constexpr double kUnitRoundoff = 0x1p-53;
// A plane face of a file is bent by a coordinate's error in each of three directions at the corner and at the
// three corners that the plane is put through: sqrt(3) (1 + 3) errors.
constexpr double kErrorsToFlat = 7.0;

// What the search for a plane looks at. More of each finds fewer pieces, slowly: these are reached by small
// solids only.
constexpr std::size_t kNotchesTried = 48;
constexpr std::size_t kPlanesOfNotch = 16;
// Sections of triangles that are looked at before a cut: about 3 ms.
constexpr std::size_t kTrianglesSectioned = 40000;
constexpr std::size_t kFewestPlanes = 12;
// Planes of one notch that fail in turn before the solid is given up.
constexpr int kCutsPerPiece = 16;

struct Candidate {
  NotchPlane by;
  int gain = 0;  // notches removed less those crossed
};

/// The planes through one notch that pass through others.
class PlanesAbout {
 public:
  PlanesAbout(const CutSurface& surface, int notch, double tolerance_m)
      : surface_(surface),
        notch_(notch),
        tolerance_m_(tolerance_m),
        origin_(surface.point(surface.tail(notch))) {
    along_ = (surface.point(surface.head(notch)) - origin_).normalized();
    basis_ = tangentBasis(along_);
  }

  std::vector<NotchPlane> planes(const std::vector<int>& notches) const {
    std::vector<NotchPlane> found;
    for (const int facet : {surface_.facetOf(notch_), surface_.facetOf(surface_.mate(notch_))})
      found.push_back({surface_.facet(facet), notch_, facet});
    const Vec3 left = surface_.facet(surface_.facetOf(notch_)).normal.cross(along_);
    const Vec3 right = -surface_.facet(surface_.facetOf(surface_.mate(notch_))).normal.cross(along_);
    if ((left + right).norm() > 1e-3) addPlane((left + right).normalized(), found);
    for (const Vec3& direction : sharedDirections(notches)) addPlane(direction, found);
    return found;
  }

 private:
  /// A point's direction from the notch's line, as a number that grows with the angle from 0 to 180 degrees.
  struct Sight {
    double turn = 0.0;
    Vec2 from_line = Vec2::Zero();
  };

  void addPlane(const Vec3& direction, std::vector<NotchPlane>& planes) const {
    const Vec3 normal = along_.cross(direction).normalized();
    const Plane plane{normal, dot(normal, origin_)};
    if (surface_.divides(plane, notch_)) planes.push_back({plane, notch_, -1});
  }

  Vec2 fromLine(const Vec3& p) const { return {dot(basis_.t1, p - origin_), dot(basis_.t2, p - origin_)}; }
  static double offLine(const Vec2& direction, const Vec2& q) {
    return std::abs(direction.x() * q.y() - direction.y() * q.x()) / direction.norm();
  }

  /// What lies in one direction from the notch.
  struct Shared {
    int count = 0;
    Vec2 direction = Vec2::Zero();  // to the farthest
    double nearest = std::numeric_limits<double>::infinity();
  };

  /// The notches that lie whole in one direction from this one, around its line.
  std::vector<Sight> sightsOf(const std::vector<int>& notches) const {
    std::vector<Sight> sights;
    for (const int other : notches) {
      Vec2 far = fromLine(surface_.point(surface_.tail(other)));
      Vec2 near = fromLine(surface_.point(surface_.head(other)));
      if (far.squaredNorm() < near.squaredNorm()) std::swap(far, near);
      if (far.norm() <= tolerance_m_ || offLine(far, near) > tolerance_m_) continue;
      const Vec2 upper = far.y() < 0.0 || (far.y() == 0.0 && far.x() < 0.0) ? Vec2(-far) : far;
      sights.push_back({1.0 - upper.x() / (std::abs(upper.x()) + upper.y()), upper});
    }
    std::stable_sort(sights.begin(), sights.end(),
                     [](const Sight& a, const Sight& b) { return a.turn < b.turn; });
    return sights;
  }

  /// The directions from the notch in which most other notches lie whole, the most first, then the nearest.
  std::vector<Vec3> sharedDirections(const std::vector<int>& notches) const {
    const std::vector<Sight> sights = sightsOf(notches);
    std::vector<Shared> shared;
    for (std::size_t i = 0, end = 0; i < sights.size(); i = end) {
      Shared group{.direction = sights[i].from_line};
      for (end = i; end < sights.size(); ++end) {
        const Vec2& q = sights[end].from_line;
        // The nearer of two points is the better seen from the line through the farther.
        const bool farther = q.squaredNorm() > group.direction.squaredNorm();
        if (offLine(farther ? q : group.direction, farther ? group.direction : q) > tolerance_m_) break;
        if (farther) group.direction = q;
        group.nearest = std::min(group.nearest, q.norm());
        ++group.count;
      }
      shared.push_back(group);
    }
    std::stable_sort(shared.begin(), shared.end(), [](const Shared& a, const Shared& b) {
      return std::tuple(-a.count, a.nearest) < std::tuple(-b.count, b.nearest);
    });
    std::vector<Vec3> directions;
    for (std::size_t i = 0; i < std::min(shared.size(), kPlanesOfNotch); ++i)
      directions.push_back(shared[i].direction.x() * basis_.t1 + shared[i].direction.y() * basis_.t2);
    return directions;
  }

  const CutSurface& surface_;
  int notch_;
  double tolerance_m_;
  Vec3 origin_, along_;
  TangentBasis basis_;
};

/// The volume that some triangles enclose, m^3; they are closed.
double volumeOf(const CutSurface& surface, std::span<const int> triangles) {
  const Vec3& origin = surface.point(surface.triangle(triangles[0])[0]);
  double volume = 0.0;
  for (const int t : triangles) {
    const Triangle& c = surface.triangle(t);
    volume +=
        dot(surface.point(c[0]) - origin, (surface.point(c[1]) - origin).cross(surface.point(c[2]) - origin));
  }
  return volume / 6.0;
}

/// Whether the shell is around the point, which is on no triangle: a ray from there leaves it.
bool surrounds(const CutSurface& surface, std::span<const int> shell, const Vec3& p) {
  const Vec3 ray(0.5773, 0.6431, 0.5027);  // along nothing in particular
  int crossings = 0;
  for (const int t : shell) {
    const Triangle& c = surface.triangle(t);
    const Vec3 a = surface.point(c[0]) - p, b = surface.point(c[1]) - p, d = surface.point(c[2]) - p;
    const double ab = dot(ray, a.cross(b)), bd = dot(ray, b.cross(d)), da = dot(ray, d.cross(a));
    const bool positive = ab >= 0.0 && bd >= 0.0 && da >= 0.0, negative = ab < 0.0 && bd < 0.0 && da < 0.0;
    if (!positive && !negative) continue;
    if ((dot(a, b.cross(d)) >= 0.0) == positive) ++crossings;
  }
  return crossings % 2 == 1;
}

class Cutting {
 public:
  Cutting(const ClosedSurface& surface, const DecompositionSettings& settings, double tolerance_m)
      : settings_(settings), tolerance_m_(tolerance_m) {
    std::vector<std::vector<int>> shells(surface.within.size());
    for (std::size_t t = 0; t < surface.shell.size(); ++t) {
      const int shell = surface.shell[t], around = surface.within[at(shell)];
      shells[at(around < 0 ? shell : around)].push_back(
          static_cast<int>(t));  // a cavity with what is around it
    }
    const CutSurface whole(surface, tolerance_m);
    for (const std::vector<int>& shell : shells)
      if (!shell.empty()) waiting_.push_back(whole.part(shell));
  }

  /// Cuts until no notch is left.
  void run(DecompositionReport& report) {
    for (const CutSurface& piece : waiting_) report.notches += static_cast<int>(piece.notches().size());
    while (!waiting_.empty()) {
      CutSurface piece = std::move(waiting_.back());
      waiting_.pop_back();
      const std::vector<int> notches = piece.notches();
      if (notches.empty()) {
        done_.push_back(std::move(piece));
        continue;
      }
      // Each cut leaves its notch on no piece, so that their number is bounded by what may come of it.
      if (static_cast<int>(done_.size() + waiting_.size()) >= settings_.most_pieces ||
          ++report.cuts > kCutsPerPiece * settings_.most_pieces)
        throw InputError(tooMany(report));
      // A notch that no plane divides is none to rounding; whether the piece is convex is seen at the end.
      if (cutOnce(piece, notches))
        separate(piece);
      else
        done_.push_back(std::move(piece));
    }
  }

  const std::vector<CutSurface>& pieces() const { return done_; }

 private:
  std::string tooMany(const DecompositionReport& report) const {
    return "its surface has " + std::to_string(report.notches) + " concave edges and needs more than " +
           std::to_string(settings_.most_pieces) + " convex pieces";
  }

  // A cut must take its notch away. Beside a face as thin as rounding it may make another like it, and would
  // be followed by cuts without end, each through all that the last ones left.
  bool cutOnce(CutSurface& piece, const std::vector<int>& notches) const {
    const CutSurface whole = piece;
    for (const NotchPlane& by : bestPlanes(piece, notches)) {
      const std::size_t divided = at(crossed(by, piece, notches));
      if (piece.cut(by) && piece.notches().size() < notches.size() + divided) return true;
      piece = whole;
    }
    return false;
  }

  /// Notches that the plane crosses, anywhere in the piece.
  int crossed(const NotchPlane& by, const CutSurface& piece, const std::vector<int>& notches) const {
    return static_cast<int>(std::count_if(notches.begin(), notches.end(), [&](int half) {
      const double a = by.plane.signedDistance(piece.point(piece.tail(half)));
      const double b = by.plane.signedDistance(piece.point(piece.head(half)));
      return std::abs(a) > tolerance_m_ && std::abs(b) > tolerance_m_ && (a > 0.0) != (b > 0.0);
    }));
  }

  /// Of all notches those whose solid angles are farthest from flat, times their length.
  static std::vector<int> deepest(const CutSurface& piece, const std::vector<int>& notches) {
    if (notches.size() <= kNotchesTried) return notches;
    std::vector<std::pair<double, int>> depths;
    for (const int half : notches) {
      const Vec3& left = piece.facet(piece.facetOf(half)).normal;
      const Vec3& right = piece.facet(piece.facetOf(piece.mate(half))).normal;
      const Vec3 edge = piece.point(piece.head(half)) - piece.point(piece.tail(half));
      depths.push_back({-(left - right).norm() * edge.norm(), half});
    }
    std::sort(depths.begin(), depths.end());
    std::vector<int> chosen;
    for (std::size_t i = 0; i < kNotchesTried; ++i) chosen.push_back(depths[i].second);
    return chosen;
  }

  /// Notches that the plane removes less those that it crosses.
  int gainOf(const NotchPlane& by, const CutSurface& piece, const std::vector<int>& notches) const {
    const auto is_on = [&](int v) {
      return std::abs(by.plane.signedDistance(piece.point(v))) <= tolerance_m_;
    };
    const auto removed = std::count_if(notches.begin(), notches.end(), [&](int half) {
      return is_on(piece.tail(half)) && is_on(piece.head(half)) && piece.divides(by.plane, half);
    });
    return static_cast<int>(removed) - crossed(by, piece, notches);
  }

  std::vector<NotchPlane> bestPlanes(CutSurface& piece, const std::vector<int>& notches) const {
    std::vector<Candidate> candidates;
    for (const int notch : deepest(piece, notches))
      for (const NotchPlane& by : PlanesAbout(piece, notch, tolerance_m_).planes(notches))
        candidates.push_back({by, gainOf(by, piece, notches)});
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
    struct Judged {
      CutEffect effect;
      NotchPlane by;
      int gain() const { return effect.notches_removed - effect.notches_crossed; }
    };
    std::vector<Judged> judged;
    const std::size_t tried = std::max(kFewestPlanes, kTrianglesSectioned / at(piece.triangleCount()));
    for (std::size_t i = 0; i < std::min(candidates.size(), tried); ++i)
      judged.push_back({piece.effect(notches, candidates[i].by), candidates[i].by});
    std::stable_sort(judged.begin(), judged.end(), [](const Judged& a, const Judged& b) {
      return std::tuple(-a.gain(), a.effect.area_m2) < std::tuple(-b.gain(), b.effect.area_m2);
    });
    std::vector<NotchPlane> best;
    best.reserve(candidates.size());
    for (const Judged& one : judged) best.push_back(one.by);
    for (std::size_t i = judged.size(); i < candidates.size(); ++i) best.push_back(candidates[i].by);
    return best;
  }

  /// What the cut has made of a piece: each connected shell, a cavity with the shell around it.
  void separate(const CutSurface& piece) {
    std::vector<std::vector<int>> shells, cavities;
    for (std::vector<int>& shell : piece.shells())
      (volumeOf(piece, shell) < 0.0 ? cavities : shells).push_back(std::move(shell));
    if (shells.empty()) return;  // nothing but rounding encloses nothing
    for (const std::vector<int>& cavity : cavities) {
      const Vec3& p = piece.point(piece.triangle(cavity[0])[0]);
      std::vector<int>* around = &shells[0];
      for (std::vector<int>& shell : shells)
        if (surrounds(piece, shell, p)) around = &shell;
      around->insert(around->end(), cavity.begin(), cavity.end());
    }
    for (std::vector<int>& shell : shells) {
      std::sort(shell.begin(), shell.end());
      waiting_.push_back(piece.part(shell).withoutFlatPoints());
    }
  }

  const DecompositionSettings& settings_;
  double tolerance_m_;
  std::vector<CutSurface> waiting_, done_;
};

/// A piece when nothing is to be cut any more: its points, its volume, and its hull where it has one.
struct ConvexPiece {
  int number = -1;
  std::vector<Vec3> points;
  double volume_m3 = 0.0;
  std::optional<ConvexPolyhedron> hull;
  Eigen::AlignedBox3d bounds;
};

double surfaceArea(const ConvexPolyhedron& polyhedron) {
  double area = 0.0;
  for (int f = 0; f < polyhedron.faceCount(); ++f) {
    const std::span<const int> loop = polyhedron.faceVertices(f);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += (polyhedron.vertex(loop[i]) - polyhedron.vertex(loop[0]))
                 .cross(polyhedron.vertex(loop[i + 1]) - polyhedron.vertex(loop[0]));
    area += 0.5 * sum.norm();
  }
  return area;
}

class Merging {
 public:
  Merging(const Cutting& cutting, const DecompositionSettings& settings, double tolerance_m)
      : settings_(settings), tolerance_m_(tolerance_m) {
    for (const CutSurface& piece : cutting.pieces()) pieces_.push_back(collected(piece));
  }

  /// The smallest first: what is thin goes with what is beside it.
  void run(DecompositionReport& report) {
    for (bool more = true; more;) {
      more = false;
      std::vector<std::size_t> order(pieces_.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return pieces_[a].volume_m3 < pieces_[b].volume_m3;
      });
      std::vector<char> gone(pieces_.size(), 0);
      for (const std::size_t a : order)
        for (std::size_t b = 0; b < pieces_.size() && !gone[a]; ++b) {
          if (a == b || gone[b]) continue;
          std::optional<ConvexPiece> whole = merged(pieces_[a], pieces_[b]);
          if (!whole) continue;
          pieces_[b] = *std::move(whole);
          gone[a] = 1;
          ++report.merged;
          more = true;
        }
      std::vector<ConvexPiece> kept;
      for (std::size_t i = 0; i < pieces_.size(); ++i)
        if (!gone[i]) kept.push_back(std::move(pieces_[i]));
      pieces_ = std::move(kept);
    }
  }

  std::vector<ConvexPolyhedron> take(DecompositionReport& report) {
    std::vector<ConvexPolyhedron> polyhedra;
    for (ConvexPiece& piece : pieces_) {
      if (!piece.hull) {
        ++report.slivers;
        report.sliver_volume_m3 += piece.volume_m3;
        continue;
      }
      const double volume = polyhedronMass(*piece.hull).mass;
      report.volume_m3 += volume;
      if (std::abs(volume - piece.volume_m3) > allowance(*piece.hull)) {
        std::ostringstream message;
        const Vec3 p = piece.bounds.center();
        message << "a part of it at (" << p.x() << ", " << p.y() << ", " << p.z()
                << ") is not convex after all cuts: details are finer than rounding";
        throw InputError(message.str());
      }
      polyhedra.push_back(*std::move(piece.hull));
    }
    return polyhedra;
  }

 private:
  ConvexPiece collected(const CutSurface& surface) {
    std::vector<int> all(at(surface.triangleCount()));
    std::iota(all.begin(), all.end(), 0);
    ConvexPiece made;
    made.number = pieces_made_++;
    made.points = surface.points();
    made.volume_m3 = volumeOf(surface, all);
    measure(made);
    return made;
  }

  void measure(ConvexPiece& piece) const {
    measure(piece, {.coordinate_error_m = settings_.coordinate_error_m});
  }

  void measure(ConvexPiece& piece, const HullSettings& settings) const {
    for (const Vec3& p : piece.points) piece.bounds.extend(p);
    try {
      piece.hull = convexHull(piece.points, settings).polyhedron;
      // Corners in the middle of faces and edges need not be looked at again.
      piece.points = piece.hull->vertices();
    } catch (const InputError&) {
      piece.hull.reset();  // flat
    }
  }

  /// How far the volume of what is convex to the tolerance may be from that of its hull.
  double allowance(const ConvexPolyhedron& hull) const { return 2.0 * tolerance_m_ * surfaceArea(hull); }

  /// The faces of `a` that have some of `b` before them: one, where the two make a convex piece.
  bool mayJoin(const ConvexPiece& a, const ConvexPiece& b) const {
    if (!a.hull) return true;
    int beyond = 0;
    for (int f = 0; f < a.hull->faceCount() && beyond < 2; ++f) {
      const Plane& plane = a.hull->plane(f);
      const bool some = std::any_of(b.points.begin(), b.points.end(), [&](const Vec3& p) {
        return plane.signedDistance(p) > 2.0 * tolerance_m_;
      });
      beyond += some ? 1 : 0;
    }
    return beyond < 2;
  }

  std::optional<ConvexPiece> merged(const ConvexPiece& a, const ConvexPiece& b) {
    Eigen::AlignedBox3d reach = a.bounds;
    reach.min().array() -= tolerance_m_;
    reach.max().array() += tolerance_m_;
    const std::pair<int, int> pair = std::minmax({a.number, b.number});
    if (!reach.intersects(b.bounds) || apart_.contains(pair)) return std::nullopt;
    ConvexPiece whole;
    std::vector<Vec3> points = a.points;
    points.insert(points.end(), b.points.begin(), b.points.end());
    whole.volume_m3 = a.volume_m3 + b.volume_m3;
    const auto fits = [&](const HullSettings& hull, double allowances) {
      whole.points = points;
      measure(whole, hull);
      return whole.hull && std::abs(polyhedronMass(*whole.hull).mass - whole.volume_m3) <=
                               allowances * allowance(*whole.hull);
    };
    // First without faces that are merged: to make those flat takes longest, and most pairs do not fit. It
    // reaches to the outermost points, where merged faces go between them.
    if (!mayJoin(a, b) || !mayJoin(b, a) || !fits({}, 2.0) ||
        !fits({.coordinate_error_m = settings_.coordinate_error_m}, 1.0)) {
      apart_.insert(pair);
      return std::nullopt;
    }
    whole.number = pieces_made_++;
    return whole;
  }

  const DecompositionSettings& settings_;
  double tolerance_m_;
  std::vector<ConvexPiece> pieces_;
  int pieces_made_ = 0;
  std::set<std::pair<int, int>> apart_;  // by number, the lower first: tried, and no convex piece together
};

}  // namespace

double flatTolerance(const SurfaceMesh& mesh, double coordinate_error_m) {
  double largest = 0.0;
  for (const Vec3& p : mesh.vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return std::max(kRoundings * kUnitRoundoff * largest, kErrorsToFlat * coordinate_error_m);
}

ConvexDecomposition convexDecomposition(const ClosedSurface& surface, const DecompositionSettings& settings) {
  REQUIRE(settings.coordinate_error_m >= 0.0 && settings.most_pieces > 0, settings.coordinate_error_m,
          settings.most_pieces);
  ConvexDecomposition made;
  made.report.tolerance_m = flatTolerance(surface.mesh, settings.coordinate_error_m);
  Cutting cutting(surface, settings, made.report.tolerance_m);
  cutting.run(made.report);
  Merging merging(cutting, settings, made.report.tolerance_m);
  merging.run(made.report);
  made.pieces = merging.take(made.report);
  return made;
}

}  // namespace carom
