#include "demos/motion/simulation_check.h"

#include <algorithm>
#include <sstream>

#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {

bool isFinite(const BodyState& state) {
  return state.X_WB.position.allFinite() && state.X_WB.rotation.coeffs().allFinite() &&
         state.linear_velocity.allFinite() && state.angular_velocity.allFinite();
}

}  // namespace

void checkStep(const World& world, const Audit& audit, std::span<const std::string> names, RunFacts& facts) {
  facts.smallest_gap_m = std::min(facts.smallest_gap_m, audit.smallest_gap_m);
  facts.events += audit.last_step.events;
  facts.work_J = audit.work_J;
  facts.kinematic_late_s = audit.kinematic_late_s;
  facts.stopped_bodies += audit.last_step.stopped_bodies;
  facts.iteration_limits += audit.last_step.iteration_limits;
  std::ostringstream message;
  message << "the simulation is invalid after step " << world.stepCount() << " (" << world.time() << " s): ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (isFinite(world.states()[i])) continue;
    message << "the state of \"" << names[i] << "\" is not finite";
    throw SimulationInvalid(message.str());
  }
  if (audit.smallest_gap_m > 0.0) return;
  message << "the smallest gap is " << audit.smallest_gap_m << " m; it must stay above 0";
  throw SimulationInvalid(message.str());
}

}  // namespace carom::demos
