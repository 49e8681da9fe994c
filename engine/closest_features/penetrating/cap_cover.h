#pragma once
// Whether the support of the Minkowski difference M = A - B is a depth D or more in every direction of a cap
// of the sphere of directions, shown by a few of its points. (Elsewhere balls within the bodies show it.)
//
// A point w of M shows it in the directions n with n . w >= D, which are a cap as well. Where a facet at the
// height D holds the foot of the origin, its normal is on the rim of each of its corners' caps: they cover
// what is around the normal, up to where the rims of neighbours cross again, at the mirror image of the
// normal in the plane of the origin and the side. If such a crossing is within the cap that is to be covered,
// a point of M that is higher in that direction comes between the two: its cap covers the crossing, and there
// are two new ones farther out.
//
// The proof. Follow the crossings around from cap to cap. Whatever that closed path winds around is covered:
// at first, as it is made of triangles normal - crossing - crossing, each within one cap; and on, as a new
// cap changes the path by triangles between crossings, each within one of the caps. (They are less than half
// the sphere, so they hold what is between two of their points.) No order and no orientation matters for
// that, only that each crossing is in both caps, which is checked, and that some direction is in none of
// them: the one opposite to the normal. At first the path winds around the normal once; and that stays so, as
// no cap holds the normal inside, so no triangle winds around it. Once no crossing is left in the wanted cap,
// the path can be led through each cap around the outside of it; it winds around all of it then, as it does
// around the normal, which is there. Tested in tests/engine/closest_features/penetrating/cap_cover_test.cpp.

#include <array>

#include "engine/closest_features/pair/polyhedron_pair.h"

namespace carom {

/// The directions n with n . point > level.
struct DirectionCap {
  Vec3 point = Vec3::Zero();
  double level_m = 0.0;

  bool holds(const Vec3& n) const { return dot(n, point) > level_m; }
  bool isEmpty() const { return level_m >= 0.0 && level_m * level_m >= point.squaredNorm(); }
};

/// A direction this close to a cap, relative to its lengths, is in it.
inline constexpr double kCapMargin = 1e-9;
/// Slopes below are rounding.
inline constexpr double kLevelSlope = 0x1p-50;

class CapCover {
 public:
  /// Of a facet of M: its unit normal and its height over the origin, > 0. `wanted`: the cap to cover.
  CapCover(const PolyhedronPair& pair, const Vec3& normal, double depth_m, double noise_m,
           const DirectionCap& wanted);

  static constexpr std::size_t kMostCorners = 16;
  /// The facet's next corner around, between the vertices a and b, and the direction in which its cap's rim
  /// and the next one's cross, other than the facet's normal. At most `kMostCorners`.
  void addCorner(int a, int b, const Vec3& crossing);

  enum class Outcome {
    kCovered,   ///< The support is the depth or more in all of the cap.
    kLower,     ///< Next to `lower`, within it, the support is less, or there is a tie.
    kUndecided  ///< Too many points would be needed.
  };
  Outcome cover();

  /// A direction in which the support is not above the depth, and the vertices whose difference has it: away
  /// from that point it falls.
  struct Lower {
    Vec3 direction = Vec3::Zero();
    int a = -1;
    int b = -1;
  };
  const Lower& lower() const { return lower_; }

 private:
  struct Cap {
    int a, b;  // the vertices whose difference is w
    Vec3 w;
    Vec3 crossing;   // of its rim and the next one's
    bool is_open;    // the crossing is in the wanted cap
    bool is_placed;  // w is known
    std::size_t before, next;
  };

  static constexpr std::size_t kMostCaps = kMostCorners + 16;

  bool holds(const Cap& cap, const Vec3& n) const { return dot(n, cap.w) >= depth_m_ - noise_m_; }
  void setCrossing(std::size_t i, const Vec3& n);
  void connect(std::size_t cap, std::size_t next);
  bool cross(std::size_t i);
  void place(Cap& cap) const;
  bool findHigher(Cap& cap, const Cap& from);
  Outcome coverCrossing(std::size_t i);

  const PolyhedronPair& pair_;
  Vec3 normal_;
  double depth_m_;
  double noise_m_;
  DirectionCap wanted_;
  double outside_m_;   // a crossing that is lower along the wanted cap's point is certain to be outside
  double turn_ = 1.0;  // to which side of the plane of two neighbours their rims cross outside
  std::array<Cap, kMostCaps> caps_;
  std::size_t count_ = 0;
  int around_ = 0;  // caps that others have not taken the place of
  // A stack of caps whose crossings were open when they were set: one of each corner, two of each cap added.
  std::array<std::size_t, 2 * kMostCaps> open_;
  std::size_t open_count_ = 0;
  Lower lower_;
};

}  // namespace carom
