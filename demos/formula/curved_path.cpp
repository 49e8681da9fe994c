#include "demos/formula/curved_path.h"

#include <algorithm>
#include <cmath>

#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr std::size_t kSamples = 256;  // Of a piece: its arc is measured in chords.

/// The piece that a time lies in, and how far; times beyond the ends lie at them.
struct Span {
  std::size_t piece = 0;
  double share = 0.0;
  double length = 1.0;
};
Span spanOf(std::span<const double> times, double time) {
  if (times.size() < 2 || time <= times.front()) return {};
  const std::size_t last = times.size() - 1;
  if (time >= times.back()) return {last - 1, 1.0, times[last] - times[last - 1]};
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  const std::size_t piece = static_cast<std::size_t>(after - times.begin()) - 1;
  const double length = times[piece + 1] - times[piece];
  return {piece, (time - times[piece]) / length, length};
}

/// The slope at an inner keyframe: the weighted harmonic mean of those beside it, 0 where they turn.
double slopeAt(std::span<const double> times, std::span<const double> values, std::size_t k) {
  if (k == 0 || k + 1 >= times.size()) return 0.0;
  const double before_s = times[k] - times[k - 1], after_s = times[k + 1] - times[k];
  const double before = (values[k] - values[k - 1]) / before_s, after = (values[k + 1] - values[k]) / after_s;
  if (!(before * after > 0.0)) return 0.0;
  const double w1 = 2.0 * after_s + before_s, w2 = after_s + 2.0 * before_s;
  return (w1 + w2) / (w1 / before + w2 / after);
}

}  // namespace

CurvedPath::CurvedPath(std::vector<Vec3> points) : points_(std::move(points)) {
  REQUIRE(points_.size() >= 2, points_.size());
  // The end pieces go on as straight as they can: with the neighbour mirrored at the end.
  const Vec3 before = 2.0 * points_[0] - points_[1];
  const Vec3 after = 2.0 * points_.back() - points_[points_.size() - 2];
  points_.insert(points_.begin(), before);
  points_.push_back(after);
  lengths_m_.push_back(0.0);
  Vec3 last = points_[1];
  for (std::size_t piece = 0; piece + 3 < points_.size(); ++piece)
    for (std::size_t i = 1; i <= kSamples; ++i) {
      const Vec3 p = onPiece(piece, static_cast<double>(i) / kSamples);
      lengths_m_.push_back(lengths_m_.back() + (p - last).norm());
      last = p;
    }
}

// The pyramid of Barry and Goldman, with knots as far apart as the roots of the distances.
Vec3 CurvedPath::onPiece(std::size_t piece, double share) const {
  double knot[4] = {0.0, 0.0, 0.0, 0.0};
  for (std::size_t i = 1; i < 4; ++i)
    knot[i] = knot[i - 1] + std::sqrt((points_[piece + i] - points_[piece + i - 1]).norm());
  const double t = knot[1] + share * (knot[2] - knot[1]);
  const auto between = [&](const Vec3& a, const Vec3& b, int from, int to) -> Vec3 {
    return ((knot[to] - t) * a + (t - knot[from]) * b) / (knot[to] - knot[from]);
  };
  const Vec3* p = &points_[piece];
  const Vec3 a = between(p[0], p[1], 0, 1), b = between(p[1], p[2], 1, 2), c = between(p[2], p[3], 2, 3);
  return between(between(a, b, 0, 2), between(b, c, 1, 3), 1, 2);
}

Vec3 CurvedPath::at(double share) const {
  const double length = std::clamp(share, 0.0, 1.0) * length_m();
  const auto after = std::upper_bound(lengths_m_.begin(), lengths_m_.end() - 1, length);
  const std::size_t sample = static_cast<std::size_t>(after - lengths_m_.begin()) - 1;
  const double chord = lengths_m_[sample + 1] - lengths_m_[sample];
  const double within = chord > 0.0 ? (length - lengths_m_[sample]) / chord : 0.0;
  return onPiece(sample / kSamples, (static_cast<double>(sample % kSamples) + within) / kSamples);
}

double easedShare(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

double monotoneAt(std::span<const double> times, std::span<const double> values, double time) {
  if (times.size() == 1) return values[0];
  const auto [k, s, length] = spanOf(times, time);
  if (s == 0.0) return values[k];
  if (s == 1.0) return values[k + 1];
  const double m0 = slopeAt(times, values, k) * length, m1 = slopeAt(times, values, k + 1) * length;
  const double s2 = s * s, s3 = s2 * s;
  return values[k] + (values[k + 1] - values[k]) * (3.0 * s2 - 2.0 * s3) + m0 * (s3 - 2.0 * s2 + s) +
         m1 * (s3 - s2);
}

double linearAt(std::span<const double> times, std::span<const double> values, double time) {
  if (times.size() == 1) return values[0];
  const auto [k, s, unused] = spanOf(times, time);
  if (s == 1.0) return values[k + 1];
  return values[k] + s * (values[k + 1] - values[k]);
}

}  // namespace carom::demos
