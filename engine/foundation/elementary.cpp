#include "engine/foundation/elementary.h"

#include <cmath>

namespace carom {
namespace {

// pi/2 in two pieces, the first with 33 significant bits: quarter * kHalfPiHigh is exact up to 2^20 quarters.
constexpr double kHalfPiHigh = 0x1.921fb544p+0;
constexpr double kHalfPiLow = 0x1.0b4611a626331p-34;
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

// Taylor sums on |x| <= pi/4: the first term left out is below 1e-17.
double sineNear(double x) {
  const double s = x * x;
  return x * (1.0 +
              s * (-1.0 / 6 +
                   s * (1.0 / 120 +
                        s * (-1.0 / 5040 + s * (1.0 / 362880 + s * (-1.0 / 39916800 +
                                                                    s * (1.0 / 6227020800.0 +
                                                                         s * (-1.0 / 1307674368000.0))))))));
}
double cosineNear(double x) {
  const double s = x * x;
  return 1.0 +
         s * (-1.0 / 2 +
              s * (1.0 / 24 +
                   s * (-1.0 / 720 + s * (1.0 / 40320 +
                                          s * (-1.0 / 3628800 + s * (1.0 / 479001600 +
                                                                     s * (-1.0 / 87178291200.0 +
                                                                          s * (1.0 / 20922789888000.0))))))));
}

// The angle in [0, pi] with this sine >= 0 and cosine (both scaled by one factor). Newton's step on
// sin(target - angle) has a cubic error: from at most 0.34 rad, four steps reach rounding.
double angleOfUnit(double sine, double cosine) {
  constexpr double kHalfPi = 1.5707963267948966;
  double angle = kHalfPi * (1.0 - cosine);
  for (int i = 0; i < 4; ++i) {
    const SineCosine at = sineCosine(angle);
    angle += sine * at.cosine - cosine * at.sine;
  }
  return angle;
}

}  // namespace

SineCosine sineCosine(double angle) {
  const double quarter = std::nearbyint(angle * kTwoOverPi);
  const double x = (angle - quarter * kHalfPiHigh) - quarter * kHalfPiLow;
  const double s = sineNear(x);
  const double c = cosineNear(x);
  switch (static_cast<long long>(quarter) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double angleOf(double y, double x) {
  const double length = std::sqrt(x * x + y * y);
  if (!(length > 0.0)) return 0.0;
  const double angle = angleOfUnit(std::abs(y) / length, x / length);
  return y < 0.0 ? -angle : angle;
}

// x = k ln 2 + rest, the rest summed by Taylor's series: |rest| <= 0.35, so the first term left out is below
// 1e-17.
double exponential(double x) {
  constexpr double kLn2High = 0x1.62e42fefap-1;  // 34 significant bits: k * kLn2High is exact
  constexpr double kLn2Low = 0x1.cf79abc9e3b3ap-40;
  constexpr double kLog2e = 0x1.71547652b82fep+0;
  const double k = std::nearbyint(x * kLog2e);
  const double rest = (x - k * kLn2High) - k * kLn2Low;
  double sum = 1.0;
  for (int i = 14; i >= 1; --i) sum = 1.0 + rest * sum / i;
  return std::ldexp(sum, static_cast<int>(k));
}

Vec3 rotationOf(const Quat& q) {
  const Vec3 v = q.w() < 0.0 ? Vec3(-q.vec()) : Vec3(q.vec());
  const double sine = v.norm();
  // Twice the angle over the sine tends to 2.
  return sine > 1e-9 ? Vec3((2.0 * angleOfUnit(sine, std::abs(q.w())) / sine) * v) : Vec3(2.0 * v);
}

Quat rotationBy(const Vec3& rotation) {
  const double angle = rotation.norm();
  const SineCosine half = sineCosine(0.5 * angle);
  // sin(x/2)/x tends to 1/2.
  const double scale = angle > 0.0 ? half.sine / angle : 0.5;
  return Quat(half.cosine, scale * rotation.x(), scale * rotation.y(), scale * rotation.z());
}

}  // namespace carom
