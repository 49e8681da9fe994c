#pragma once
// V-Clip's walk (paper §2; Mirtich 1997): from a feature pair to a neighbouring pair that is closer, until
// each witness lies in the V-region of the other's feature.
//
// Why it ends, in floating point too. The distance of two closed features is a pure function of the pair, and
// the walk keeps the lowest it has seen. A move is taken only if
// - that number falls, which it can do only as often as there are feature pairs, or
// - the new pair is as close to rounding and its features have more dimensions together, which can follow
//   itself at most four times.
// So no sequence of moves is longer than five times the number of pairs, whatever rounding does.
//
// Where it ends is the answer: by convexity two points each in the other's V-region are the closest points of
// the whole bodies, and a violated V-region offers a closer pair. Rounding and degeneracy hide it in three
// ways, each looked for before the walk stops:
// - the way between the witnesses runs inside a body (the local minimum behind a face, and on the flat edges
// of
//   coplanar faces, whose V-planes do not tell out from in): the other witness is inside too, or the way
//   enters the body through a face that is closer;
// - between almost parallel features a step on one body gains half the slope squared, below rounding, and a
//   step on both the slope itself: the free slab between the support planes bounds what is left to gain, and
//   the axes of all features level with these are tried;
// - witnesses within rounding of each other have no direction: the walk says kInside, and the axes decide.
// Tested in tests/engine/closest_features/vclip_test.cpp.

#include <array>

#include "engine/closest_features/core_answer.h"

namespace carom {

/// The vertices that face each other along the line of centres: where a walk begins that knows nothing.
FeaturePair coldSeed(const PolyhedronPair& pair);

enum class Move {
  kTaken,   ///< Closer, or as close with features of more dimensions.
  kClear,   ///< The end: every way off these features leads away by more than rounding.
  kStuck,   ///< The end: no way off leads closer, but some are level.
  kInside,  ///< The end: a point of both bodies is found, or one nearer than rounding tells.
};

class FeatureWalk {
 public:
  /// `size_m`: what lengths of this query are compared with; `noise_m`: how far rounding may move a point.
  FeatureWalk(const PolyhedronPair& pair, FeaturePair seed, double size_m, double noise_m);

  Move next();
  /// Goes on from a pair if that is closer: from a given one, or from what faces each other along the line of
  /// centres or along the way between the witnesses.
  void jumpTo(FeaturePair seed) { moveTo(seed); }
  void jump();

  const FeatureDistance& here() const { return seen_[here_]; }
  /// After kInside: the witness that lies in both bodies.
  const Vec3& commonPoint() const { return common_is_on_a_ ? here().p_a : here().p_b; }

 private:
  bool moveTo(FeaturePair features);
  Move enterA();
  Move enterB();
  Move moveToEntry(int face, bool entered_a);
  bool moveToLevelAxis();
  bool moveAlongBoth(const Vec3& n, const Vec3& minus_n_B);

  const PolyhedronPair& pair_;
  double size_m_, noise_m_, noise_slope_;
  std::array<FeatureDistance, 2> seen_;
  std::size_t here_ = 0;
  double lowest_m2_;
  bool common_is_on_a_ = false;
};

}  // namespace carom
