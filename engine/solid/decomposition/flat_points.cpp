// What a cut leaves in the middle of flat facets and of straight edges: the next cuts would cross a triangle
// for each. Such points go by edge collapse (Hoppe, DeRose, Duchamp, McDonald and Stuetzle 1993), where that
// moves the surface by no more than rounding and turns no triangle over. Tested in
// tests/engine/solid/decomposition/flat_points_test.cpp.

#include <algorithm>
#include <cmath>

#include "engine/solid/decomposition/cut_surface.h"

namespace carom {

class CutSurface::FlatPoints {
 public:
  explicit FlatPoints(CutSurface& surface)
      : surface_(surface),
        outgoing_(surface.points_.size(), -1),
        uses_(surface.points_.size(), 0),
        mark_(surface.points_.size(), 0),
        gone_(surface.triangles_.size(), 0) {
    for (int half = 0; half < 3 * surface.triangleCount(); ++half) {
      outgoing_[at(surface.tail(half))] = half;
      ++uses_[at(surface.tail(half))];
    }
  }

  /// The triangles that are left.
  std::vector<int> remove() {
    for (int v = 0; v < static_cast<int>(uses_.size()); ++v)
      if (uses_[at(v)] > 2) removeIfFlat(v);
    std::vector<int> left;
    for (int t = 0; t < surface_.triangleCount(); ++t)
      if (!gone_[at(t)]) left.push_back(t);
    return left;
  }

 private:
  const Vec3& p(int v) const { return surface_.point(v); }
  static int previous(int half) { return half % 3 == 0 ? half + 2 : half - 1; }

  /// The sides that begin at the point, around it; false where its triangles are not one fan.
  bool fanOf(int v, std::vector<int>& fan) const {
    fan.clear();
    int half = outgoing_[at(v)];
    do {
      fan.push_back(half);
      half = surface_.mate(previous(half));
    } while (half != outgoing_[at(v)] && fan.size() < at(uses_[at(v)]));
    return half == outgoing_[at(v)] && fan.size() == at(uses_[at(v)]);
  }

  void removeIfFlat(int v) {
    if (!fanOf(v, fan_)) return;
    std::vector<int> creases;
    for (const int half : fan_) {
      if (!liesInFacet(half)) return;
      if (surface_.facetOf(half) != surface_.facetOf(surface_.mate(half))) creases.push_back(half);
    }
    if (!creases.empty() && !(creases.size() == 2 && isStraight(creases[0], creases[1]))) return;
    for (const int half : creases.empty() ? fan_ : creases)
      if (mayCollapse(half)) {
        collapse(half);
        return;
      }
  }

  bool liesInFacet(int half) const {
    const Plane& plane = surface_.facet(surface_.facetOf(half));
    return std::ranges::all_of(surface_.triangle(half / 3), [&](int v) {
      return std::abs(plane.signedDistance(p(v))) <= surface_.tolerance_m_;
    });
  }

  bool isStraight(int one, int other) const {
    const Vec3 a = p(surface_.head(one)) - p(surface_.tail(one));
    const Vec3 b = p(surface_.head(other)) - p(surface_.tail(other));
    return dot(a, b) < 0.0 && a.cross(b).norm() <= surface_.tolerance_m_ * (a - b).norm();
  }

  /// Whether the side's tail may move to its head, with `fan_` around the tail.
  bool mayCollapse(int half) {
    const int to = surface_.head(half);
    const int left = surface_.head(next(half)), right = surface_.head(next(surface_.mate(half)));
    if (uses_[at(left)] < 4 || uses_[at(right)] < 4 || !fanOf(to, other_fan_)) return false;
    // The link condition: the two ends have no neighbours in common but the two beside the edge.
    ++stamp_;
    for (const int side : fan_) {
      int& mark = mark_[at(surface_.head(side))];
      if (mark == stamp_) return false;
      mark = stamp_;
    }
    if (std::ranges::count_if(other_fan_,
                              [&](int side) { return mark_[at(surface_.head(side))] == stamp_; }) != 2)
      return false;
    return std::ranges::all_of(fan_, [&](int side) { return staysUpright(side, to); });
  }

  /// Whether the side's triangle, if it is left, has area when its tail is elsewhere.
  bool staysUpright(int side, int to) const {
    const int b = surface_.head(side), c = surface_.head(next(side));
    if (b == to || c == to) return true;
    const Vec3 ab = p(b) - p(to), ac = p(c) - p(to);
    const double longest_m =
        std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()}));
    return dot(surface_.facet(surface_.facetOf(side)).normal, ab.cross(ac)) >
           surface_.tolerance_m_ * longest_m;
  }

  void collapse(int half) {
    const int from = surface_.tail(half), to = surface_.head(half), back = surface_.mate(half);
    const int left = surface_.head(next(half)), right = surface_.head(next(back));
    for (const int side : fan_) surface_.triangles_[at(side / 3)][at(side % 3)] = to;
    gone_[at(half / 3)] = gone_[at(back / 3)] = 1;
    const int to_left = surface_.mate(previous(half)), left_to = surface_.mate(next(half));
    const int right_to = surface_.mate(next(back)), to_right = surface_.mate(previous(back));
    surface_.pair(to_left, left_to);
    surface_.pair(right_to, to_right);
    outgoing_[at(to)] = to_left;
    outgoing_[at(left)] = left_to;
    outgoing_[at(right)] = right_to;
    uses_[at(to)] += uses_[at(from)] - 4;
    --uses_[at(left)];
    --uses_[at(right)];
  }

  CutSurface& surface_;
  std::vector<int> outgoing_, uses_, mark_;  // by point: a side that begins there, its triangles, a mark
  std::vector<char> gone_;                   // by triangle
  std::vector<int> fan_, other_fan_;
  int stamp_ = 0;
};

CutSurface CutSurface::withoutFlatPoints() && {
  const std::vector<int> left = FlatPoints(*this).remove();
  return part(left);
}

}  // namespace carom
