#include "engine/environment/sphere_piece.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/foundation/elementary.h"

namespace carom {
namespace {

// Signed area of the spherical triangle a, b, c (Van Oosterom and Strackee 1983).
double triangleArea(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2.0 * angleOf(dot(a, b.cross(c)), 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

struct BorderSums {
  SphereIntegrals sum;
  Mat3 conormal = Mat3::Zero();  ///< The integral of nu x^T ds.

  // A great arc with outward conormal d, from `p` by `angle` along `t`.
  void addGreatArc(const Vec3& d, const Vec3& p, const Vec3& t, double angle, const Vec3& apex) {
    const SineCosine at = sineCosine(angle);
    sum.area += triangleArea(apex, p, at.cosine * p + at.sine * t);
    sum.first -= 0.5 * angle * d;
    conormal += d * (at.sine * p + (1.0 - at.cosine) * t).transpose();
  }

  // The cutting circle x = c n + s q(phi), q = e1 cos phi + e2 sin phi, from phi0 to phi1, walked backwards
  // (the piece lies below).
  void addCircleArc(const Vec3& n, double c, const TangentBasis& e, double phi0, double phi1) {
    const double s = std::sqrt((1.0 - c) * (1.0 + c));
    const SineCosine b = sineCosine(phi0), t = sineCosine(phi1);
    const double width = phi1 - phi0;
    const Vec3 q = (t.sine - b.sine) * e.t1 + (b.cosine - t.cosine) * e.t2;
    const double cc = 0.5 * (width + t.sine * t.cosine - b.sine * b.cosine);
    const double cs = 0.5 * (t.sine - b.sine) * (t.sine + b.sine);
    const Mat3 qq = cc * e.t1 * e.t1.transpose() + (width - cc) * e.t2 * e.t2.transpose() +
                    cs * (e.t1 * e.t2.transpose() + e.t2 * e.t1.transpose());
    const Vec3 x = c * width * n + s * q;
    const Mat3 xx =
        c * c * width * n * n.transpose() + c * s * (n * q.transpose() + q * n.transpose()) + s * s * qq;
    sum.area += (1.0 + c) * width;
    sum.first += 0.5 * (c * x - width * n);
    conormal += n * x.transpose() - c * xx;
  }

  SphereIntegrals finish() {
    const Mat3 second = (sum.area * Mat3::Identity() - conormal) / 3.0;
    sum.second = 0.5 * (second + second.transpose());
    return sum;
  }
};

// Where A cos t + B sin t = c, within (low, high).
void appendRoots(double a, double b, double c, double low, double high, std::vector<double>& roots) {
  const double reach = std::sqrt(a * a + b * b);
  if (!(std::abs(c) < reach)) return;
  const double cosine = c / reach;
  const double off = angleOf(std::sqrt((1.0 - cosine) * (1.0 + cosine)), cosine);
  const double middle = angleOf(b, a);
  for (double t : {middle - off, middle + off})
    for (double turn : {-2.0 * std::numbers::pi, 0.0, 2.0 * std::numbers::pi})
      if (t + turn > low && t + turn < high) roots.push_back(t + turn);
}

}  // namespace

void SpherePiece::addArc(const Vec3& d, const Vec3& corner, const Vec3& other) {
  const bool forwards = dot(d, other.cross(corner)) >= 0.0;
  const double angle = 2.0 * angleOf((corner - other).norm(), (corner + other).norm());
  arcs_.push_back({d, forwards ? corner : other, angle});
}

void SpherePiece::addHemisphere(const Vec3& d) {
  const TangentBasis basis = tangentBasis(d);
  const SineCosine third = sineCosine(2.0 * std::numbers::pi / 3.0);
  for (double side : {0.0, 1.0, -1.0}) {
    const Vec3 from = side == 0.0 ? basis.t1 : Vec3(third.cosine * basis.t1 + side * third.sine * basis.t2);
    arcs_.push_back({d, from, 2.0 * std::numbers::pi / 3.0});
  }
}

bool SpherePiece::contains(const Vec3& x) const {
  return std::all_of(arcs_.begin(), arcs_.end(), [&](const Arc& arc) { return dot(arc.d, x) <= 0.0; });
}

SphereIntegrals SpherePiece::below(const Vec3& n, double c) {
  if (c <= -1.0) return {};
  const bool whole = c >= 1.0;
  BorderSums border;
  // Spherical triangles fan out from the lowest point, which sees all but the highest; the whole piece, from
  // a corner of its own.
  const Vec3 apex = whole && !arcs_.empty() ? arcs_.front().from : Vec3(-n);
  for (const Arc& arc : arcs_) {
    const Vec3 t = arc.from.cross(arc.d);
    angles_.assign({0.0, arc.angle});
    if (!whole) appendRoots(dot(n, arc.from), dot(n, t), c, 0.0, arc.angle, angles_);
    std::sort(angles_.begin(), angles_.end());
    for (std::size_t i = 0; i + 1 < angles_.size(); ++i) {
      const SineCosine middle = sineCosine(0.5 * (angles_[i] + angles_[i + 1]));
      if (!whole && dot(n, middle.cosine * arc.from + middle.sine * t) > c) continue;
      const SineCosine at = sineCosine(angles_[i]);
      border.addGreatArc(arc.d, at.cosine * arc.from + at.sine * t, at.cosine * t - at.sine * arc.from,
                         angles_[i + 1] - angles_[i], apex);
    }
  }
  if (whole) {
    if (arcs_.empty()) border.sum.area = 4.0 * std::numbers::pi;
    return border.finish();
  }
  const TangentBasis e = tangentBasis(n);
  const double s = std::sqrt((1.0 - c) * (1.0 + c));
  angles_.assign({-std::numbers::pi, std::numbers::pi});
  for (const Arc& arc : arcs_)
    appendRoots(s * dot(arc.d, e.t1), s * dot(arc.d, e.t2), -c * dot(arc.d, n), -std::numbers::pi,
                std::numbers::pi, angles_);
  std::sort(angles_.begin(), angles_.end());
  for (std::size_t i = 0; i + 1 < angles_.size(); ++i) {
    const SineCosine middle = sineCosine(0.5 * (angles_[i] + angles_[i + 1]));
    if (contains(c * n + s * (middle.cosine * e.t1 + middle.sine * e.t2)))
      border.addCircleArc(n, c, e, angles_[i], angles_[i + 1]);
  }
  return border.finish();
}

}  // namespace carom
