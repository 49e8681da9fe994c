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

void applyTimes(double factor, std::span<const ContactRow> rows, std::span<ImpulseBody> bodies) {
  for (ContactRow row : rows) {
    row.impulse *= factor;
    row.torque *= factor;
    applyLoad(row, bodies);
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
  const double share = gains ? std::clamp(-before / twice_energy, 0.0, 1.0) : 1.0;
  applyTimes(share, rows, bodies);
  if (!gains) return;
  for (ContactRow& row : rows) {
    row.impulse *= share;
    row.torque *= share;
  }
}

}  // namespace carom
