#pragma once
// V-Clip's walk (paper §2; Mirtich 1997): from a feature pair to a neighbouring pair that is closer, until
// each witness lies in the V-region of the other's feature.
//
// Why it ends, in floating point too (DEVIATES: the paper's "never cycles" is true in exact arithmetic only).
// Every move lowers, in lexicographic order, three pure functions of the pair:
// - the lowest distance seen so far, which falls only as often as there are feature pairs;
// - at a distance equal to that to rounding: the dimensions that the two features lack, at most four;
// - at as many dimensions: the margin between the support planes and the distance.
// So no pair is visited twice at the same lowest distance, whatever rounding does.
//
// Where it ends is the answer: by convexity two points each in the other's V-region are the closest points of
// the whole bodies, and a violated V-region offers a closer pair. Rounding and degeneracy hide it in three
// ways, each looked for before the walk stops:
// - the way between the witnesses runs inside a body (the local minimum behind a face, and at the flat edges
//   of coplanar faces, whose V-planes do not tell out from in): the other witness is inside too, or the way
//   enters the body through a face that is closer;
// - between almost parallel features a step on one body gains half the slope squared, below rounding, and a
//   step on both the slope itself: the free slab between the support planes bounds what is left to gain, and
//   the axes and pairs of all features level with these are tried;
// - witnesses within rounding of each other have no direction: the walk says kInside, and the axes decide.
// Begun far off, on exact lattice poses, a walk can still stop between borders of V-regions: the margin that
// the support planes leave tells (kLost), and the axis of the widest slab leads on. Tested in
// tests/engine/closest_features/separated/feature_walk_test.cpp, vclip_test.cpp and stale_seed_test.cpp.

#include <array>

#include "engine/closest_features/pair/core_answer.h"

namespace carom {

/// An answer that support planes leave a larger margin than this, relative to the size, is not proven.
inline constexpr double kUnproven = 0x1p-41;

enum class Move {
  kTaken,   ///< Closer, or as close with features of more dimensions.
  kClear,   ///< The end: every way off these features leads away by more than rounding.
  kLevel,   ///< The end: no way off leads closer, but some are level.
  kInside,  ///< The end: a point of both bodies is found, or one nearer than rounding tells.
  kLost     ///< No way on, but the support planes leave a margin for a shorter one: the axes have to lead on.
};

class FeatureWalk {
 public:
  /// `size_m`: what lengths of this query are compared with; `noise_m`: how far rounding may move a point.
  FeatureWalk(const PolyhedronPair& pair, FeaturePair seed, double size_m, double noise_m);

  Move next();
  /// Goes on from a pair if that is closer: from a given one (whether it was), or from what faces each other
  /// along the line of centres or along the way between the witnesses.
  bool jumpTo(FeaturePair seed) { return moveTo(seed); }
  void jump();
  /// Begins anew: at a pair, however far, or at what another search has found.
  void restart(FeaturePair seed);
  void startFrom(const FeatureDistance& found);

  const FeatureDistance& here() const { return seen_[here_]; }
  /// After kClear: the answer.
  CoreAnswer answer() const {
    return {here().distance(), across_.unit(), here().p_a, here().p_b, here().features};
  }
  /// After kInside: the witness that lies in both bodies.
  const Vec3& commonPoint() const { return common_is_on_a_ ? here().p_a : here().p_b; }

 private:
  bool moveTo(FeaturePair features);
  bool asClose(const FeatureDistance& there) const;
  Move enterA();
  Move enterB();
  Move moveToEntry(int face, bool entered_a);
  bool moveToLevelAxis();
  bool moveAlongBoth(const Vec3& n, const Vec3& minus_n_B);
  bool moveToWiderSlab(FeaturePair features, double slab_m);

  const PolyhedronPair& pair_;
  double size_m_, noise_m_, noise_slope_;
  std::array<FeatureDistance, 2> seen_;
  std::size_t here_ = 0;
  double lowest_m2_;
  Across across_;  // of the pair that next() last looked at
  bool common_is_on_a_ = false;
};

}  // namespace carom
