#include "engine/response/one_point/point_collision.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

// One step of the integration changes the slip by this share of it.
constexpr double kTurnShare = 0.07;
// The longest step, as a share of slip over stiffness: Runge-Kutta steps are stable below 2.7.
constexpr double kStableShare = 1.0;
// A slip that changes at an angle of a smaller sine to itself goes straight on.
constexpr double kStraight = 1e-10;
// Of the velocity before: a slip that ends, and turns by less until then, is taken to go straight on as well.
constexpr double kUnnoticed = 1e-7;
// Of the velocity before: what is slower does not slip.
constexpr double kNoSlip = 1e-12;
// A slip that turns for more steps has found the direction in which it neither grows nor ends.
constexpr int kMostSlipSteps = 2000;
// Rounds in which a step is fitted to the end of a phase within it, at most.
constexpr int kLengthRounds = 8;
// Of the step's length and of the impulse: a step that ends this near to the end of its phase fits.
constexpr double kFit = 1e-12;
// A step that cannot be fitted is halved this often at most.
constexpr int kHalvings = 40;
// Steps of Newton's method that seek the direction of departure, at most.
constexpr int kDepartureRounds = 60;
constexpr double kForever = std::numeric_limits<double>::infinity();

// The state while the normal impulse p grows. Where d impulse / dp = xi is constant, the velocity is linear
// in p and the work of the normal force, the integral of u dp, quadratic.
class Course {
 public:
  explicit Course(const PointCollision& collision) : c_(&collision), velocity_(collision.velocity) {}

  enum class Phase : std::uint8_t { kCompression, kRestitution, kEnded };
  Phase phase() const { return phase_; }
  const Vec3& impulse() const { return impulse_; }
  const Vec3& velocity() const { return velocity_; }

  // Goes along `xi` for at most `longest` of normal impulse, but not beyond the end of the phase. Where xi is
  // the mean of one that changes, its double integral, which gives the work, is that of `xi_of_work`.
  void advance(const Vec3& xi, const Vec3& xi_of_work, double longest) {
    const double rate = dot(c_->response.row(0).transpose(), xi);
    const double rate_of_work = dot(c_->response.row(0).transpose(), xi_of_work);
    const bool compresses = phase_ == Phase::kCompression;
    bool turns_back = false;
    const double whole = compresses ? compressionLeft(rate) : restitutionLeft(rate_of_work, turns_back);
    const double p = std::min(longest, whole);
    if (p == kForever) {  // no direction of friction lets a point approach for ever
      phase_ = Phase::kEnded;
      return;
    }
    work_ += p * (velocity_.x() + 0.5 * rate_of_work * p);
    impulse_ += p * xi;
    velocity_ = c_->velocity + c_->response * impulse_;
    if (p < whole) return;
    if (!compresses && velocity_.x() < -kNoSlip * c_->velocity.norm()) turns_back = true;
    if (compresses) {
      least_work_ = std::min(least_work_, work_);
      phase_ = c_->restitution > 0.0 ? Phase::kRestitution : Phase::kEnded;
    } else {
      phase_ = turns_back ? Phase::kCompression : Phase::kEnded;
    }
  }

  void advance(const Vec3& xi, double longest) { advance(xi, xi, longest); }

 private:
  double compressionLeft(double rate) const {
    if (!(rate > 0.0)) return kForever;
    return std::max(0.0, -velocity_.x() / rate);
  }

  // To where the work is given back, or the point stops separating before that.
  double restitutionLeft(double rate, bool& turns_back) const {
    const double u = std::max(0.0, velocity_.x());
    const double e = c_->restitution;
    const double missing = std::max(0.0, (1.0 - e * e) * least_work_ - work_);
    const double squared = u * u + 2.0 * rate * missing;
    turns_back = squared < 0.0 || (u == 0.0 && rate <= 0.0);
    if (turns_back) return rate < 0.0 ? -u / rate : 0.0;
    return 2.0 * missing / (u + std::sqrt(squared));
  }

  const PointCollision* c_;
  Phase phase_ = Phase::kCompression;
  Vec3 impulse_ = Vec3::Zero();
  Vec3 velocity_;
  double work_ = 0.0;
  double least_work_ = 0.0;  ///< At the end of compression.
};

using Phase = Course::Phase;

Vec3 slidingImpulse(double coefficient, const Vec2& direction) {
  return {1.0, -coefficient * direction.x(), -coefficient * direction.y()};
}

// Slip, as long as there is one.
class Slip {
 public:
  explicit Slip(const PointCollision& collision)
      : c_(collision),
        stopped_(kNoSlip * collision.velocity.norm()),
        unnoticed_(kUnnoticed * collision.velocity.norm()),
        stiffness_(collision.friction.dynamic_coefficient *
                   collision.response.bottomRightCorner<2, 2>().norm()) {}

  void follow(Course& course) const {
    for (int step = 0; step < kMostSlipSteps && slips(course); ++step) {
      const Vec3& u = course.velocity();
      const Vec2 slip = u.tail<2>();
      const Vec2 rate = (c_.response * along(u)).tail<2>();
      const double pace = rate.norm();
      const double turning = std::abs(slip.x() * rate.y() - slip.y() * rate.x()) / pace;
      const bool ends = dot(slip, rate) < 0.0 && turning <= unnoticed_;
      if (!rubs() || !(turning > kStraight * slip.norm()) || ends)
        goStraight(course);
      else
        turn(course, slip.norm() * std::min(kTurnShare / pace, kStableShare / stiffness_));
    }
  }

 private:
  bool slips(const Course& course) const {
    return course.phase() != Phase::kEnded && speed(course.velocity()) > stopped_;
  }
  bool rubs() const { return c_.friction.dynamic_coefficient > 0.0; }

  // Along the slip there is, to where that stops.
  void goStraight(Course& course) const {
    const Vec3 xi = along(course.velocity());
    const Vec2 slip = course.velocity().tail<2>();
    const double growth = dot(slip, (c_.response * xi).tail<2>()) / slip.squaredNorm();
    course.advance(xi, rubs() && growth < 0.0 ? -1.0 / growth : kForever);
  }

  static double speed(const Vec3& velocity) { return velocity.tail<2>().norm(); }
  Vec3 along(const Vec3& velocity) const {
    const double slip = speed(velocity);
    return slip > 0.0 ? slidingImpulse(c_.friction.dynamic_coefficient, velocity.tail<2>() / slip)
                      : Vec3(Vec3::UnitX());
  }

  // A step, shortened to the end of a phase within it; where that cannot be fitted, a step half as long.
  void turn(Course& course, double length) const {
    for (int halving = 0; halving < kHalvings; ++halving) {
      double fitted = length;
      for (int round = 0; round < kLengthRounds; ++round) {
        const Course after = stepped(course, fitted);
        const double went = after.impulse().x() - course.impulse().x();
        const double rounding = kFit * (length + after.impulse().x());
        if (after.phase() == course.phase() || went <= rounding || std::abs(went - fitted) <= rounding) {
          course = after;
          return;
        }
        fitted = went;
      }
      length *= 0.5;
    }
    course = stepped(course, length);
  }

  // The classical Runge-Kutta method.
  Course stepped(const Course& course, double length) const {
    const Vec3& u = course.velocity();
    const Vec3 k1 = along(u);
    const Vec3 k2 = along(u + 0.5 * length * (c_.response * k1));
    const Vec3 k3 = along(u + 0.5 * length * (c_.response * k2));
    const Vec3 k4 = along(u + length * (c_.response * k3));
    Course after = course;
    after.advance((k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0, (k1 + k2 + k3) / 3.0, length);
    return after;
  }

  const PointCollision& c_;
  double stopped_;
  double unnoticed_;
  double stiffness_;  ///< A bound on how fast friction turns the slip, times the slip.
};

// The direction in which a slip begins that friction cannot hold: there d slip / dp = lambda direction with
// lambda > 0, so (mu K_tt + lambda) direction = K_tn, and lambda is where the solution has length one. The
// reciprocal of that length is nearly linear in lambda.
Vec2 departure(const PointCollision& c) {
  const Vec2 drive = c.response.bottomLeftCorner<2, 1>();
  const double mu = c.friction.dynamic_coefficient;
  if (mu == 0.0) return drive.normalized();
  double lambda = 0.0;
  Vec2 direction = drive.normalized();
  for (int round = 0; round < kDepartureRounds; ++round) {
    const Eigen::Matrix2d matrix =
        mu * c.response.bottomRightCorner<2, 2>() + lambda * Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d inverse = matrix.inverse();
    direction = inverse * drive;
    const double length = direction.norm();
    const double step = (length - 1.0) * length * length / dot(direction, inverse * direction);
    if (!(step > 1e-15 * (lambda + matrix.trace()))) break;
    lambda += step;
  }
  return direction.normalized();
}

// Where there is no slip: the impulse that holds the point, if friction can; else the slip that begins stays
// on its way.
Vec3 impulseWithoutSlip(const PointCollision& c) {
  const Vec2 drive = c.response.bottomLeftCorner<2, 1>();
  const Vec2 holding = -c.response.bottomRightCorner<2, 2>().inverse() * drive;
  const double limit = c.friction.static_coefficient;
  if (holding.squaredNorm() <= limit * limit) return {1.0, holding.x(), holding.y()};
  return slidingImpulse(c.friction.dynamic_coefficient, departure(c));
}

// Rounding of the course could leave more energy than there was: 2 (E_after - E_before) = J . (u_before +
// u_after).
Vec3 withoutGain(const PointCollision& c, const Vec3& impulse) {
  const double response = dot(impulse, c.response * impulse);
  const double gain = 2.0 * dot(impulse, c.velocity) + response;
  return gain > 0.0 ? Vec3(impulse * (-2.0 * dot(impulse, c.velocity) / response)) : impulse;
}

}  // namespace

Vec3 pointCollisionImpulse(const PointCollision& collision) {
  if (collision.velocity.x() >= 0.0) return Vec3::Zero();
  Course course(collision);
  Slip(collision).follow(course);
  if (course.phase() != Phase::kEnded) {
    const Vec3 xi =
        impulseWithoutSlip(collision);  // separates from the first: each phase is gone through once
    while (course.phase() != Phase::kEnded) course.advance(xi, kForever);
  }
  return withoutGain(collision, course.impulse());
}

}  // namespace carom
