#pragma once
// Our own world as a Simulation (experiment.h).

#include "engine/foundation/contract.h"
#include "engine/simulation/world.h"
#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

class CaromSimulation final : public Simulation {
 public:
  explicit CaromSimulation(const Experiment& experiment)
      : world_({experiment.step_s, Vec3(0, 0, -experiment.gravity), experiment.resting}) {
    for (const ExperimentBody& b : experiment.bodies) {
      Material material{b.friction, b.friction, b.restitution, b.mass_kg / b.shape.solid.volume()};
      material.rolling_resistance_m = b.rolling_resistance_m;
      material.spinning_resistance_m = b.spinning_resistance_m;
      world_.addBody({world_.addSolid(b.shape.solid), b.X_WB, b.velocity, b.spin, material, b.is_static});
    }
    REQUIRE(world_.start().empty());
  }

  void step() override { world_.step(); }
  Motion motion(int body) const override {
    const BodyState& s = state(body);
    return {s.X_WB, s.linear_velocity, s.angular_velocity};
  }
  bool atRest(int body) const override { return state(body).mode == Mode::kResting; }

 private:
  const BodyState& state(int body) const { return world_.states()[static_cast<std::size_t>(body)]; }
  World world_;
};

inline std::unique_ptr<Simulation> startCarom(const Experiment& experiment) {
  return std::make_unique<CaromSimulation>(experiment);
}

inline constexpr Simulator kCarom{"Carom", startCarom, true, true};

}  // namespace carom::physics
