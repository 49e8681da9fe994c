#pragma once
// What the world is told and what it tells, as plain values: what all that makes its step knows of it.
// The world itself is world.h. Tested in tests/engine/simulation/.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/environment/air.h"
#include "engine/environment/applied_load.h"
#include "engine/environment/fluid.h"
#include "engine/foundation/frames.h"
#include "engine/motion/axis_locks.h"
#include "engine/motion/prescribed_path.h"

namespace carom {

struct Material {
  double static_friction = 0.5;
  double dynamic_friction = 0.5;
  double restitution = 0.0;
  double density_kgpm3 = 1000.0;
  std::optional<double> drag_coefficient = {};  ///< In air and water; none: the standard one of the shape.
  // Torques that lasting contact bears against turning, over its normal force; 0: none.
  double rolling_resistance_m = 0.0;
  double spinning_resistance_m = 0.0;  ///< About the normal.
};

/// What a body does at the moment (paper §2.4, §2.5).
enum class Mode : std::uint8_t {
  kStatic,     ///< Never moves.
  kFree,       ///< In flight: no lasting contact.
  kColliding,  ///< Took a collision impulse in the last step.
  kSliding,    ///< In lasting contact, moving along it.
  kContact,    ///< In lasting contact without sliding: rolling, tipping, settling.
  kResting,    ///< Lies on others with exactly zero velocity.
  kKinematic   ///< On its prescribed path.
};
const char* modeName(Mode mode);

/// Empty braces are no zero vector (Eigen leaves what they make as it finds it): Vec3::Zero() is.
struct BodyDescription {
  int solid = 0;  ///< Index returned by World::addSolid.
  Pose X_WB;      ///< Pose of the solid's own frame (centre of mass).
  Vec3 linear_velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Material material;
  bool is_static = false;
  /// In place of the material's density, kg: it is scaled so that the body has this mass.
  std::optional<double> mass_kg = {};
  /// The body goes along a path that nothing changes: from `X_WB` at the constant velocities, or through
  /// `keyframes`, the first of which is where it starts (`X_WB` and the velocities are then not asked).
  /// Rather than come through what cannot give way it stops at the last safe time, and is late on its path
  /// from then on (Audit::kinematic_late_s).
  bool is_kinematic = false;
  std::vector<Keyframe> keyframes = {};
  Interpolation interpolation = Interpolation::kLinear;
  bool repeats = false;
  AxisLocks locks = {};   ///< Of a body that moves freely: no velocity along or about what is locked.
  AppliedLoad load = {};  ///< Likewise: what acts on it besides its environment.
};

/// What can be seen of a body at the end of a step.
struct BodyState {
  Pose X_WB;
  Vec3 linear_velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Mode mode = Mode::kFree;
};

struct WorldSettings {
  double step_s = 1.0 / 240.0;
  Vec3 gravity = Vec3(0.0, 0.0, -9.81);
  bool resting_mode = true;  ///< Off: bodies are simulated even when they lie still.
  Air air = {};
  std::vector<Fluid> fluids = {};
  int threads = 1;  ///< That step crowds together; changes no bit of the outcome.
};

/// Two bodies that overlap at the start, by how much and where. 0 deep: they touch and have no room to part.
struct Overlap {
  int body_a = -1;
  int body_b = -1;
  double depth_m = 0.0;
  Vec3 p_W = Vec3::Zero();  ///< Halfway between the deepest points.
};

/// What happened in one step.
struct StepCounters {
  int candidate_pairs = 0;
  int distance_queries = 0;
  long states_walked = 0;  ///< Feature pairs visited by these queries.
  int contact_points = 0;
  int events = 0;           ///< Times at which impulses acted between steps.
  int impacts = 0;          ///< Events that are roots: fast approaches that came into the window.
  int landings = 0;         ///< Pairs without restitution whose search found them to come down, held in time.
  int projected_paths = 0;  ///< Bodies whose paths were led along their contacts; each time counts.
  int cleared_paths = 0;    ///< Times that two paths were led apart, without impulses.
  long row_visits = 0;      ///< Contact rows looked at by the solvers of lasting contacts and paths.
  int newton_steps = 0;     ///< Of the searches for times of impact.
  int stopped_bodies = 0;   ///< Each once, if held at a safe time because a budget was reached.
  int iteration_limits = 0;   ///< Closest-feature walks that reached their bound.
  int active_bodies = 0;      ///< Bodies that the step looked at: they move, or came to rest the step before.
  int active_pairs = 0;       ///< Pairs that the step looked at: those of these bodies.
  int rest_test_rows = 0;     ///< Rows that were looked at to tell whether islands come to rest.
  int stopped_kinematic = 0;  ///< Kinematic bodies that were stopped at something that cannot give way.
  double work_J = 0.0;        ///< Done by kinematic bodies and by loads (BodyDescription).
  int substeps = 1;  ///< The step was made in so many equal parts: sums are over all of them, pairs and
                     ///< points those of the last.

  void addQuery(long states) {
    ++distance_queries;
    states_walked += states;
  }
};

/// Sums over the bodies that can move.
struct Audit {
  double time_s = 0.0;
  double kinetic_energy_J = 0.0;
  double potential_energy_J = 0.0;  ///< -m g . x, zero at the world's origin, and the fluid displaced.
  Vec3 linear_momentum = Vec3::Zero();
  Vec3 angular_momentum = Vec3::Zero();  ///< About the world's origin.
  double smallest_gap_m = 0.0;           ///< Over candidate pairs; +infinity when there is none.
  /// Done by kinematic bodies and by loads since the start: what the energies may have grown by.
  double work_J = 0.0;
  double kinematic_late_s = 0.0;  ///< The most that a kinematic body has been stopped for since the start.
  int resting_bodies = 0;
  StepCounters last_step;
};

}  // namespace carom
