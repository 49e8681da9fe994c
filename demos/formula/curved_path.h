#pragma once
// Smooth ways through given places. A curve through points in space is a centripetal Catmull-Rom spline
// (Barry and Goldman, SIGGRAPH 1988; Yuksel, Schaefer and Keyser, Computer-Aided Design 43, 2011: no cusps,
// no loops within a piece), walked by the length of its arc. A value through keyframes in time is a monotone
// cubic (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980): never beyond the keyframes around it, so that
// what stands between two of them stands. Tested in tests/demos/formula/curved_path_test.cpp.

#include <span>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom::demos {

class CurvedPath {
 public:
  /// At least two points; no two neighbours in one place.
  explicit CurvedPath(std::vector<Vec3> points);

  double length_m() const { return lengths_m_.back(); }
  /// The point after so much of its length, in [0, 1].
  Vec3 at(double share) const;

 private:
  Vec3 onPiece(std::size_t piece, double share) const;

  std::vector<Vec3> points_;       // with one more beyond each end
  std::vector<double> lengths_m_;  // of the arc up to each sample
};

/// 0 at 0, 1 at 1, at rest at both ends: 3 s^2 - 2 s^3.
double easedShare(double share);

/// The value at `time` of the monotone cubic, at rest at both ends, through `values` at `times`, which rise;
/// outside of them the nearest value.
double monotoneAt(std::span<const double> times, std::span<const double> values, double time);
/// The same on straight lines.
double linearAt(std::span<const double> times, std::span<const double> values, double time);

}  // namespace carom::demos
