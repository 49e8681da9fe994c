#include "engine/response/sweeps/turning_resistance.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr double kMostUndone = 0.5;  // of a normal impulse's response, by its own torque
// Of the answer about all axes: what is added about axes that locks leave without one, of themselves or where
// the point is held. Rounding, 2^-52 of all, is so much less that what they seem to turn by takes no torque.
constexpr double kTrace = 0x1p-30;

const ImpulseBody& bodyOf(std::span<const ImpulseBody> bodies, int i) {
  return bodies[static_cast<std::size_t>(i)];
}

// How the relative angular velocity answers to a torque impulse, in the row's frame.
Mat3 turnResponse(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  const Mat3 frame = rowFrame(row);
  const Mat3 inverse = bodyOf(bodies, row.a).inverse_tensor + bodyOf(bodies, row.b).inverse_tensor;
  return frame.transpose() * inverse * frame;
}

// How the point's velocity answers to a torque impulse; transposed, the angular velocity to an impulse.
Mat3 crossResponse(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  const Mat3 frame = rowFrame(row);
  const Mat3 response = crossMatrix(row.r_a) * bodyOf(bodies, row.a).inverse_tensor +
                        crossMatrix(row.r_b) * bodyOf(bodies, row.b).inverse_tensor;
  return -(frame.transpose() * response * frame);
}

// The answer of turning, all of it or what is left of it where the point is held, with a trace about every
// axis if locks have taken some.
Mat3 withTrace(Mat3 answer, const Mat3& turning, const ContactRow& row, std::span<const ImpulseBody> bodies) {
  if (bodyOf(bodies, row.a).has_locks || bodyOf(bodies, row.b).has_locks)
    answer.diagonal().array() += kTrace * turning.trace();
  return answer;
}

// Leaves only what the axes do that resist: the others take no torque.
void keepResisting(const TurningResistance& resistance, Mat3& response, Vec3& spin) {
  for (int i = 0; i < 3; ++i) {
    if ((i == 0 ? resistance.spinning_m : resistance.rolling_m) > 0.0) continue;
    response.row(i).setZero();
    response.col(i).setZero();
    response(i, i) = 1.0;
    spin(i) = 0.0;
  }
}

// Scaled by one number along the contact, so that the fixed point is parallel to the rolling whatever the
// shape of the bodies.
Vec3 resistingTorque(const ContactRow& row, std::span<const ImpulseBody> bodies, const Mat3& response) {
  const Vec3 spin = rowSpin(row, bodies);
  const double j = std::max(0.0, row.impulse.x());
  const double spinning = row.resistance.spinning_m * j;
  const double rolling = row.resistance.rolling_m * j;
  Vec3 torque = Vec3::Zero();
  if (spinning > 0.0)
    torque.x() = std::clamp(row.torque.x() - spin.x() / response(0, 0), -spinning, spinning);
  if (rolling > 0.0)
    torque.tail<2>() =
        shortened(row.torque.tail<2>() - spin.tail<2>() / largestTangentialResponse(response), rolling);
  return torque;
}

bool isWithin(const ContactRow& row, const RowLoad& load) {
  const double j = load.impulse.x();
  const double rolling = row.resistance.rolling_m * j;
  return isInCone(row, load.impulse) && load.torque.tail<2>().squaredNorm() <= rolling * rolling &&
         std::abs(load.torque.x()) <= row.resistance.spinning_m * j;
}

}  // namespace

Vec3 rowSpin(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  return inRowFrame(row, bodyOf(bodies, row.b).velocity.angular - bodyOf(bodies, row.a).velocity.angular);
}

void applyTorqueToRow(const ContactRow& row, const Vec3& torque, std::span<ImpulseBody> bodies) {
  const Vec3 on_b = rowImpulse(row, torque);
  ImpulseBody& a = bodies[static_cast<std::size_t>(row.a)];
  ImpulseBody& b = bodies[static_cast<std::size_t>(row.b)];
  if (a.inverse_mass > 0.0) a.turn(-on_b);
  if (b.inverse_mass > 0.0) b.turn(on_b);
}

void prepareResistance(ContactRow& row, std::span<const ImpulseBody> bodies) {
  const Mat3 response = turnResponse(row, bodies);
  row.largest_turn_response = std::max(response(0, 0), largestTangentialResponse(response));
  if (row.largest_turn_response == 0.0) return endResistance(row);  // neither turns
  const Eigen::RowVector3d lift = crossResponse(row, bodies).row(0);
  const double undone =
      row.resistance.spinning_m * std::abs(lift.x()) + row.resistance.rolling_m * lift.tail<2>().norm();
  const double most = kMostUndone * row.normal_response.x();
  if (!(undone > most)) return;
  row.resistance.spinning_m *= most / undone;
  row.resistance.rolling_m *= most / undone;
}

// With impulse j and torque t: K j + C t = -miss and C^T j + L t = -spin, where K, C and L are the responses
// of point, point to torque, and turning.
bool holdsTurning(const ContactRow& row, std::span<const ImpulseBody> bodies, const Vec3& miss,
                  RowLoad& load) {
  const Mat3 cross = crossResponse(row, bodies);
  const Mat3 held = row.inverse_response * cross;
  const Mat3 turning_response = turnResponse(row, bodies);
  Mat3 response = withTrace(turning_response - cross.transpose() * held, turning_response, row, bodies);
  Vec3 spin = rowSpin(row, bodies) - held.transpose() * miss;
  keepResisting(row.resistance, response, spin);
  const Vec3 turning = -(response.inverse() * spin);
  load.torque = row.torque + turning;
  load.impulse = row.impulse - row.inverse_response * miss - held * turning;
  return isWithin(row, load);
}

RowLoad resistTurning(const ContactRow& row, std::span<const ImpulseBody> bodies, bool is_held) {
  const Mat3 response = turnResponse(row, bodies);
  if (is_held) {
    const Mat3 cross = crossResponse(row, bodies);
    const Mat3 held = row.inverse_response * cross;
    const Vec3 torque =
        resistingTorque(row, bodies, withTrace(response - cross.transpose() * held, response, row, bodies));
    const Vec3 impulse = row.impulse - held * (torque - row.torque);
    if (isInCone(row, impulse)) return {impulse, torque};
  }
  return {row.impulse, resistingTorque(row, bodies, withTrace(response, response, row, bodies))};
}

double turningAsSpeed(const ContactRow& row, const Vec3& torque) {
  return torque.norm() * std::sqrt(row.largest_turn_response * row.normal_response.x());
}

}  // namespace carom
