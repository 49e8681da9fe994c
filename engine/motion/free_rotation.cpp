#include "engine/motion/free_rotation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/foundation/elementary.h"

namespace carom {
namespace {

using std::numbers::pi;

// Of the arithmetic-geometric mean and of Carlson's duplication: a step halves, or quarters, the logarithm of
// what is between, until the differences are squared. From 1e-140 thirteen and twenty are made.
constexpr int kMostMeans = 40;
constexpr double kSameMean = 1e-15;
// The parameter differs from one by this at least: what is nearer to the rotation about the middle axis is on
// it, and products of theta functions, which grow as its inverse, stay in the range of doubles.
constexpr double kLeastComplement = 1e-140;

// The complete elliptic integral K, from the complementary modulus: pi / 2 over the arithmetic-geometric
// mean.
double quarterPeriod(double complementary_modulus) {
  double a = 1.0, b = complementary_modulus;
  for (int i = 0; i < kMostMeans && a - b > kSameMean * a; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return pi / (a + b);
}

// Carlson's integral R_F(x, y, 1), x and y in [0, 1] and not both 0 (Carlson 1979). The series leaves out the
// sixth power of the spread.
double carlsonIntegral(double x, double y) {
  constexpr double kSpread = 2e-3;
  double z = 1.0, mean = 0.0;
  for (int i = 0; i < kMostMeans; ++i) {
    mean = (x + y + z) / 3.0;
    if (std::max({x, y, z}) - std::min({x, y, z}) < kSpread * mean) break;
    const double lambda = std::sqrt(x * y) + std::sqrt(y * z) + std::sqrt(z * x);
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
  }
  const double X = 1.0 - x / mean, Y = 1.0 - y / mean, Z = -(X + Y);
  const double e2 = X * Y - Z * Z, e3 = X * Y * Z;
  return (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0) / std::sqrt(mean);
}

// The elliptic integral F of the angle with this sine and cosine, any quadrant; the parameter is one less
// `complement`.
double integralTo(double sine, double cosine, double complement, double quarter_period) {
  const double first = sine * carlsonIntegral(cosine * cosine, cosine * cosine + complement * sine * sine);
  if (cosine >= 0.0) return first;
  return std::copysign(2.0 * quarter_period, sine) - first;
}

struct Hyperbolic {
  double cosine, sine;
};
// Without loss where the argument, which is positive, is small; divided by the exponential of `scale`.
Hyperbolic hyperbolic(double x, double scale) {
  // What would overflow is multiplied by a power of the nome that is zero.
  const double grown = 0.5 * exponential(std::min(x - scale, 700.0)), shrunk = 0.5 * exponential(-x - scale);
  if (x > 1.0) return {grown + shrunk, grown - shrunk};
  double series = 1.0;
  for (int i = 18; i >= 2; i -= 2) series = 1.0 + x * x / (i * (i + 1)) * series;
  return {grown + shrunk, exponential(-scale) * x * series};
}

SineCosine turnedOn(const SineCosine& a, const SineCosine& b) {
  return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
}

// The principal axes of the body in the order x, y, z of the solution: the angular momentum goes round the
// axis of the largest moment or of the least, as its energy is below or above that of the middle one; z is
// that axis, y the middle one, and the momentum points along z rather than against it.
Quat solutionFrame(const Inertia& inertia, const Vec3& inverse, const Vec3& momentum_P, Vec3& b, Vec3& l) {
  const Quat principal(inertia.principal_axes_B);
  const double high = (inverse[1] - inverse[2]) * momentum_P[2] * momentum_P[2];
  const double low = (inverse[0] - inverse[1]) * momentum_P[0] * momentum_P[0];
  const bool round_highest = inverse[0] == inverse[1] || (inverse[1] != inverse[2] && high >= low);
  Quat frame = principal;
  if (round_highest) {
    b = inverse;
    l = momentum_P;
  } else {  // a quarter turn about y
    b = Vec3(inverse[2], inverse[1], inverse[0]);
    l = Vec3(momentum_P[2], momentum_P[1], -momentum_P[0]);
    frame = principal * Quat(std::numbers::sqrt2 / 2, 0.0, -std::numbers::sqrt2 / 2, 0.0);
  }
  if (l.z() >= 0.0) return frame;
  l = Vec3(l.x(), -l.y(), -l.z());  // half a turn about x
  return frame * Quat(0.0, 1.0, 0.0, 0.0);
}

}  // namespace

FreeRotation::FreeRotation(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity)
    : inertia_(&inertia) {
  // Of the largest component as the unit, so that no square of a slow spin vanishes.
  const double unit = angular_velocity.lpNorm<Eigen::Infinity>();
  const Vec3 direction = angular_velocity / unit;
  const Vec3 momentum_W = carom::angularMomentum(inertia, R_WB, direction);
  momentum_ = unit * momentum_W;
  // I_smallest omega^2 <= omega . I omega, at all times.
  fastest_spin_ = unit * std::sqrt(dot(direction, momentum_W) / inertia.principal_moments[0]);
  const double length = momentum_W.norm(), momentum = unit * length;
  const Vec3 inverse = inertia.principal_moments.cwiseInverse();
  const Quat R_WP = R_WB * Quat(inertia.principal_axes_B);
  Vec3 b, l;
  const Quat R_BS = solutionFrame(inertia, inverse, R_WP.conjugate() * (momentum_W / length), b, l);
  R_SB_ = R_BS.conjugate();

  // l = (l_x cn, l_y sn, l_z dn) of the parameter m. No term of these cancels another of its sum.
  const double xy = b.x() - b.y(), xz = b.x() - b.z(), yz = b.y() - b.z();
  const bool symmetric = xy == 0.0;
  const double slope = symmetric ? 1.0 : std::sqrt(yz / xz);  // l_x / l_y
  const double round = xz * l.x() * l.x() + yz * l.y() * l.y();
  const double along = xy * l.y() * l.y() + xz * l.z() * l.z();
  const double m = symmetric ? 0.0 : std::min(1.0, xy * round / (yz * along));
  const double complement =
      symmetric
          ? 1.0
          : std::clamp(xz * (yz * l.z() * l.z() - xy * l.x() * l.x()) / (yz * along), kLeastComplement, 1.0);
  const double l_y = symmetric ? std::sqrt(l.x() * l.x() + l.y() * l.y()) : std::sqrt(round / yz);
  const double l_x = slope * l_y;
  const double l_z = symmetric ? l.z() : std::sqrt(along / xz);
  const double rate = std::copysign(std::sqrt(yz * xz), yz) * l_z * momentum;

  const double k = std::sqrt(m), k_c = std::sqrt(complement);
  const double K = quarterPeriod(k_c);
  const double K_c = m > 0.0 ? quarterPeriod(k) : 0.0;
  near_separatrix_ = m > 0.5;
  const double summed = near_separatrix_ ? K_c : K, other = near_separatrix_ ? K : K_c;
  root_ = m > 0.0 ? exponential(-pi * other / (4.0 * summed)) : 0.0;
  const double scale = 0.5 * pi / summed;
  phase_rate_ = rate * scale;
  half_period_ = 2.0 * K * scale;
  phase_ = l_y > 0.0 ? scale * integralTo(l.y() / l_y, l.x() / l_x, complement, K) : 0.0;
  lean_ = slope * std::sqrt(k_c);
  side_ = near_separatrix_ ? l_y / std::sqrt(k) : m > 0.0 ? 2.0 * root_ * l_y / std::sqrt(k) : l_y;
  up_ = l_z * std::sqrt(k_c);

  const double nome = root_ * root_ * root_ * root_;
  square_[0] = between_[0] = 1.0;
  double power = 1.0;
  for (std::size_t n = 1; n < kTerms; ++n) {
    square_[n] = between_[n - 1] * (power *= nome);
    between_[n] = square_[n] * power;
  }

  // The angle about the momentum has its pole where cn / sn = i l_x / l_y.
  const double pole = symmetric ? 0.0 : scale * slope * carlsonIntegral(xy / xz, xy / xz + m * yz / xz);
  double sum = 0.0, slope_sum = 0.0;
  for (std::size_t n = 0; n < kTerms; ++n) {
    const double odd = 2.0 * static_cast<double>(n) + 1.0, sign = n % 2 == 0 ? 1.0 : -1.0;
    if (near_separatrix_) {
      const SineCosine at = sineCosine(odd * pole);
      real_[n] = sign * at.cosine;
      imaginary_[n] = sign * at.sine;
      sum += between_[n] * imaginary_[n];
      slope_sum += between_[n] * odd * real_[n];
    } else {
      // With symmetry the pole is at infinity, and only the first term is left.
      const Hyperbolic at = symmetric ? Hyperbolic{1.0, 1.0} : hyperbolic(odd * pole, pole);
      real_[n] = sign * between_[n] * at.cosine;
      imaginary_[n] = sign * between_[n] * at.sine;
      sum += imaginary_[n];
      slope_sum += odd * real_[n];
    }
  }
  skew_ = near_separatrix_ ? 2.0 * pole / half_period_ : 0.0;
  turning_ = momentum * b.x() - phase_rate_ * (skew_ + slope_sum / sum);
  R_WL_ = R_WB * R_BS * towardsMomentum(0.0).conjugate();
}

FreeRotation::Thetas FreeRotation::thetas(double phase) const {
  const SineCosine one = sineCosine(phase);
  const SineCosine two{2.0 * one.sine * one.cosine, one.cosine * one.cosine - one.sine * one.sine};
  SineCosine odd = one, even = two;
  Thetas sum;
  for (std::size_t n = 0; n < kTerms; ++n) {
    const double sign = n % 2 == 0 ? 1.0 : -1.0;
    sum.x += between_[n] * odd.cosine;
    sum.y += sign * between_[n] * odd.sine;
    sum.real += real_[n] * odd.sine;
    sum.imaginary += imaginary_[n] * odd.cosine;
    odd = turnedOn(odd, two);
    if (n == 0) continue;
    sum.z += 2.0 * square_[n] * even.cosine;
    even = turnedOn(even, two);
  }
  return sum;
}

// The same functions by Jacobi's imaginary transformation, but for a factor that they have in common.
// Products of the nome and exponentials are formed so that none overflows.
FreeRotation::Thetas FreeRotation::thetasNearSeparatrix(double phase) const {
  const double grown = exponential(phase), shrunk = 1.0 / grown;
  const double ahead = (root_ * root_ * grown) * (root_ * root_ * grown);
  const double behind = (root_ * root_ * shrunk) * (root_ * root_ * shrunk);
  double up = 1.0, down = 1.0;  // the nome to the n, times the exponential of twice n times the phase
  Thetas sum;
  for (std::size_t n = 0; n < kTerms; ++n) {
    const double sign = n % 2 == 0 ? 1.0 : -1.0;
    const double sine = square_[n] * (up * grown - down * shrunk);
    const double cosine = square_[n] * (up * grown + down * shrunk);
    sum.y += sign * root_ * sine;
    sum.real += real_[n] * sine;
    sum.imaginary += imaginary_[n] * cosine;
    up *= ahead;
    down *= behind;
    if (n + 1 == kTerms) break;
    const double even = between_[n] * (up + down);  // of n + 1
    sum.x -= sign * even;
    sum.z += even;
  }
  sum.x += 1.0;
  return sum;
}

// From S to L: the shortest way from the momentum to the z axis, then about that by the angle about the
// momentum.
Quat FreeRotation::towardsMomentum(double dt_s) const {
  const double phase = phase_ + dt_s * phase_rate_;
  const double halves = std::nearbyint(phase / half_period_);
  const double within = phase - halves * half_period_;
  const Thetas theta = near_separatrix_ ? thetasNearSeparatrix(within) : thetas(within);
  const double x = lean_ * theta.x, y = theta.y;
  const double side = std::fmod(halves, 2.0) == 0.0 ? side_ : -side_;
  const Vec3 l = Vec3(side * x, side * y, up_ * theta.z).normalized();
  // The argument of y + i x over that of the theta function.
  const double real = y * theta.real + x * theta.imaginary, imaginary = x * theta.real - y * theta.imaginary;
  const double length = std::sqrt(real * real + imaginary * imaginary);
  const SineCosine even = sineCosine(0.5 * (turning_ * dt_s + skew_ * within));
  const Quat about_momentum =
      Quat(even.cosine, 0.0, 0.0, even.sine) *
      (real >= 0.0 ? Quat(length + real, 0.0, 0.0, imaginary) : Quat(imaginary, 0.0, 0.0, length - real));
  return (about_momentum * Quat(1.0 + l.z(), l.y(), -l.x(), 0.0)).normalized();
}

Quat FreeRotation::after(double dt_s) const {
  return (R_WL_ * towardsMomentum(dt_s) * R_SB_).normalized();
}

Vec3 FreeRotation::meanSpin(const Quat& R_WB, double dt_s) const {
  const double longest = kLargestTurn / angularVelocityIn(R_WB).norm();
  const double dt = std::clamp(dt_s, -longest, longest);
  return rotationOf(after(dt) * R_WB.conjugate()) / dt;
}

double tumblingMiss(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s) {
  const Vec3 torque = angularMomentum(inertia, R_WB, angular_velocity).cross(angular_velocity);
  return angularVelocity(inertia, R_WB, torque).norm() * dt_s * dt_s / 8.0;
}

Quat torqueFreeRotation(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s) {
  if (angular_velocity.isZero(0.0)) return R_WB;
  if (inertia.isIsotropic()) return (rotationBy(dt_s * angular_velocity) * R_WB).normalized();
  return FreeRotation(inertia, R_WB, angular_velocity).after(dt_s);
}

Vec3 torqueFreeSpin(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s) {
  if (angular_velocity.isZero(0.0) || inertia.isIsotropic()) return angular_velocity;
  return FreeRotation(inertia, R_WB, angular_velocity).meanSpin(R_WB, dt_s);
}

}  // namespace carom
