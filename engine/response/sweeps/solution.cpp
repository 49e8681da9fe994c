#include "engine/response/sweeps/solution.h"

#include "engine/foundation/index.h"

namespace carom {

Solution::Solution(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies) {
  for (const ContactRow& row : rows) {
    impulses_.push_back(row.impulse);
    torques_.push_back(row.torque);
    for (const int body : {row.a, row.b}) velocities_.push_back(bodies[at(body)].velocity);
  }
}

void Solution::restore(std::span<ContactRow> rows, std::span<ImpulseBody> bodies) const {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].impulse = impulses_[i];
    rows[i].torque = torques_[i];
    bodies[at(rows[i].a)].velocity = velocities_[2 * i];
    bodies[at(rows[i].b)].velocity = velocities_[2 * i + 1];
  }
}

}  // namespace carom
