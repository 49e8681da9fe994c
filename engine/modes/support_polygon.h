#pragma once
// The support polygon (paper §2.5, figs. 9 and 10): the convex cover of the supporting contacts, projected
// along gravity, and whether the effective force on the body passes through it. DEVIATES: the paper projects
// the centre of mass along gravity; a body that carries others is pressed by their weight too, so the line of
// action of the whole force is projected instead. Tested in tests/engine/modes/support_polygon_test.cpp.

#include <span>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom {

/// Counter-clockwise, without collinear corners; one or two points when the input spans no area.
std::vector<Vec2> convexCover(std::vector<Vec2> points);

/// 0 inside or on the cover, else the distance to it, metres. Any number of corners from one.
double distanceOutside(std::span<const Vec2> cover, const Vec2& p);

/// A contact as one body feels it.
struct BodyContact {
  Vec3 p_W = Vec3::Zero();
  Vec3 n_W = Vec3::UnitZ();     ///< Unit, towards the body.
  Vec3 force_N = Vec3::Zero();  ///< On the body.
};

/// By how many metres the effective force on the body (its weight and what presses on it) misses the support
/// polygon of the contacts that hold it up; infinite when nothing holds it up. `weight_N` must not be zero.
double supportMiss(const Vec3& center_W, const Vec3& weight_N, std::span<const BodyContact> contacts);

}  // namespace carom
