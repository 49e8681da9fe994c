#pragma once
// The free paths of bodies: the exact parabola under gravity alone; through air and water the path and the
// momentum that end where the body's own flight through its environment ends (environment_flight.h). In
// between both change evenly: the environment acts as its mean force and torque, so what an impulse cuts
// short is planned anew from there, and nothing acts twice. Internal to the simulation floor. Tested in
// tests/engine/simulation/bodies/flight_plan_test.cpp and through
// tests/engine/simulation/ and tests/physics/.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/environment/environment_flight.h"
#include "engine/foundation/object_pool.h"
#include "engine/simulation/bodies/body.h"

namespace carom {

class FlightPlanner {
 public:
  FlightPlanner() = default;
  explicit FlightPlanner(const WorldSettings& settings);

  /// Once the world is complete: `solid_of` gives each body's solid.
  void begin(std::span<const Solid> solids, std::vector<int> solid_of);
  /// A body's load, or its path, the next of all bodies in turn.
  void add(const AppliedLoad& load, std::optional<PrescribedPath> path);
  /// The world's time at the beginning of the step that follows, and its length.
  void beginStep(double time_s, double step_s) {
    time_s_ = time_s;
    step_s_ = step_s;
  }

  /// May be called for several bodies at the same time. The whole step of a body that moves, as if it were in
  /// flight from the step's beginning.
  void planStep(int index, Body& body) const;
  /// Likewise: of a kinematic body, from `path.start_s` to the end of that piece of its path.
  void drive(int index, Body& body) const;
  /// Where a kinematic body is on its path at the end of the step, or where it was stopped.
  void endDrive(int index, Body& body) const;
  /// Likewise. Plans body `index` from `path.start_s` with its
  /// momentum velocity, to the end of the step.
  void plan(int index, Body& body) const;
  /// Remembers what the step's lasting contacts changed of the velocity, its angular part by the tensor of
  /// `R_WB`, for the next plan.
  void takeContacts(Body& body, const Velocity& change, const Quat& R_WB) const;
  /// For a body that no contact presses: plans it anew where its plan foresaw some.
  void leaveContacts(int index, Body& body) const;
  /// What the environment gives a body from `path.start_s` to the end of the step.
  Velocity gained(const Body& body) const;
  /// The same from `start_s` on, of a body that has been given this velocity then, as if it were in
  /// flight.
  Velocity gainedFrom(int index, const Body& body, double start_s, const Velocity& velocity) const;

  /// The velocity that the environment would give the body in one step from standstill, where there is air or
  /// water.
  Velocity pushAtRest(int index, const Body& body) const;
  /// What it takes energy to lead the body against, m/s^2: gravity, and its load as it is turned when the
  /// step begins, as far as it is free to follow them.
  Vec3 pull(int index, const Body& body) const;
  /// What its load does to a body on its path up to `end_s`, J: also added to what it has done (load_work_J).
  double countWorkOfLoad(int index, Body& body, double end_s) const;
  const AppliedLoad& load(int index) const { return loads_[static_cast<std::size_t>(index)]; }
  double step_s() const { return step_s_; }
  /// Whether gravity alone pushes the body.
  bool isWeightAll(int index, const Body& body) const;
  /// Whether the forces on a body that lies still change by themselves: it floats where waves go.
  bool restless(const Body& body) const;
  /// Energy of the body's place, J: weight, and the fluid that it displaces.
  double potential(int index, const Body& body) const;

  bool isVacuum() const { return environment_.isVacuum(); }

 private:
  void planPath(int index, Body& body) const;
  double workOfLoad(int index, const Body& body, double end_s) const;
  bool isTouched(int index, const Body& body, double rest_of_step_s) const;
  Vec3 accelerationBy(const Vec3& force_W, const Body& body) const;
  Vec3 parabolaOf(int index, const Body& body) const;
  AppliedLoad meanLoad(int index, const Body& body, double end_s) const;
  EnvironmentBody environmentBody(int index, const Body& body) const;

  Environment environment_;
  double step_s_ = 0.0;
  double time_s_ = 0.0;
  std::vector<SolidSurface> surfaces_;
  std::vector<int> solid_of_;
  std::vector<AppliedLoad> loads_;  ///< By body.
  std::vector<std::optional<PrescribedPath>> prescribed_;
  std::unique_ptr<ObjectPool<ForceScratch>> scratch_ = std::make_unique<ObjectPool<ForceScratch>>();
};

}  // namespace carom
