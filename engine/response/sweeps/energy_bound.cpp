#include "engine/response/sweeps/energy_bound.h"

#include <algorithm>

#include "engine/response/sweeps/turning_resistance.h"

namespace carom {
namespace {

// J: the impulses on the speeds by which the rows miss their bounds.
double powerOnMisses(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies) {
  double power = 0.0;
  for (const ContactRow& row : rows) {
    if (!row.impulse.isZero(0.0)) power += dot(row.impulse, rowMiss(row, bodies));
    if (!row.torque.isZero(0.0)) power += dot(row.torque, rowSpin(row, bodies));
  }
  return power;
}

// J: the impulses on the rows' velocities, less what bounds above zero allow them to give.
template <typename VelocityOf>
double workOf(std::span<const ContactRow> rows, const VelocityOf& velocityOf) {
  double work = 0.0;
  for (const ContactRow& row : rows) {
    const Velocity& a = velocityOf(row.a);
    const Velocity& b = velocityOf(row.b);
    if (!row.impulse.isZero(0.0)) {
      work += dot(row.impulse, inRowFrame(row, b.at(row.r_b) - a.at(row.r_a)));
      work -= row.impulse.x() * std::max(0.0, row.lowest_speed);
    }
    if (!row.torque.isZero(0.0)) work += dot(row.torque, inRowFrame(row, b.angular - a.angular));
  }
  return work;
}

// Where `first` + s `growth` is zero, or none where it begins above. Where it ends above, s is less than one,
// to the rounding too.
double shareOf(double first, double growth) {
  return first < 0.0 ? -first / growth : 0.0;
}

void applyTimes(double factor, std::span<const ContactRow> rows, std::span<ImpulseBody> bodies) {
  for (ContactRow row : rows) {
    row.impulse *= factor;
    row.torque *= factor;
    applyLoad(row, bodies);
  }
}

// Gives the bodies such a share of the impulses, which had been taken back, and the rows no more.
void scaleTo(double share, std::span<ContactRow> rows, std::span<ImpulseBody> bodies) {
  applyTimes(share, rows, bodies);
  for (ContactRow& row : rows) {
    row.impulse *= share;
    row.torque *= share;
  }
}

}  // namespace

void takeBackGain(std::span<ContactRow> rows, std::span<ImpulseBody> bodies) {
  const double after = powerOnMisses(rows, bodies);
  if (!(after > 0.0)) return;  // w is not negative
  applyTimes(-1.0, rows, bodies);
  const double before = powerOnMisses(rows, bodies);
  const double twice_energy = after - before;
  const bool gains = before + after > 0.0;
  scaleTo(gains ? shareOf(before, twice_energy) : 1.0, rows, bodies);
}

void takeBackWork(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                  std::span<const Velocity> before) {
  const auto now = [&](int i) -> const Velocity& { return bodies[static_cast<std::size_t>(i)].velocity; };
  const auto then = [&](int i) -> const Velocity& { return before[static_cast<std::size_t>(i)]; };
  const double at_begin = workOf(rows, then);
  const double at_end = workOf(rows, now);
  if (!(at_begin + at_end > 0.0)) return;
  applyTimes(-1.0, rows, bodies);
  const double without = workOf(rows, now);
  scaleTo(shareOf(at_begin + without, at_end - without), rows, bodies);
}

}  // namespace carom
