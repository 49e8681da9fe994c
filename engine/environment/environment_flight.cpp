#include "engine/environment/environment_flight.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/foundation/elementary.h"

namespace carom {
namespace {

// Radians of its fastest swing that a body which bobs goes in one stroke, at most: a stroke of x radians
// shortens the period by x^2/24.
constexpr double kSwing = 0.1;
// Of the speed: what the drag of air takes of it in one stroke, at most.
constexpr double kAirShare = 0.04;
// Of the speed: what the drag of a fluid takes of it in one stroke, at most.
constexpr double kFluidShare = 0.1;
// Of the speed: what drag that grows with the speed alone takes of it in one stroke, at most.
constexpr double kLinearShare = 0.2;
// Of the radius: the way in one stroke, at most.
constexpr double kWayShare = 0.25;
// Radians that a body turns in one stroke, at most.
constexpr double kTurn = 0.25;
// Strokes of a step: one that wants more makes longer ones.
constexpr int kMostStrokes = 16;

struct State {
  Pose X_WB;
  Vec3 velocity;
  Vec3 angular_momentum;
};

// The rate of the speed's change in a stream, at most: of v' = g - c v^2 at speed u, sqrt(c (g + c u^2)); no
// body shows a stream more than half of its surface.
double dragRate(double density, double coefficient, const EnvironmentBody& body, double gravity,
                double speed) {
  const double c = 0.25 * density * coefficient * body.surface->area_m2 / body.inertia->mass_kg;
  return std::sqrt(c * (gravity + c * speed * speed));
}

int strokesFor(const Environment& environment, const EnvironmentBody& body, const Pose& X_WB,
               const Velocity& velocity, double dt_s) {
  const double gravity = environment.gravity.norm();
  const double radius = body.surface->radius_m;
  const double coefficient = body.drag_coefficient.value_or(kCylinderDrag);
  const double speed = velocity.linear.norm(), turning = velocity.angular.norm();
  const double surface_speed = speed + turning * radius;
  const double way = (speed + 0.5 * gravity * dt_s) * dt_s;
  double most = 1.0;
  if (body.load != nullptr && body.load->turnsAlong()) most = std::max(most, turning * dt_s / kTurn);
  const Air& air = environment.air;
  if (air.density_kgpm3 > 0.0) {
    const double rate =
        dragRate(air.density_kgpm3, coefficient, body, gravity, surface_speed + air.wind.norm());
    most = std::max(most, rate * dt_s / kAirShare);
  }
  for (const Fluid& fluid : environment.fluids) {
    if (!reaches(fluid, X_WB.position, radius + way)) continue;
    // The stiffest float: a slab that bobs flat, omega^2 = g rho_fluid / (rho thickness).
    const double density = body.inertia->mass_kg / body.surface->volume_m3;
    const double swing = std::sqrt(gravity * fluid.density_kgpm3 / (density * body.surface->width_m));
    const double rate = dragRate(fluid.density_kgpm3, fluid.drag * coefficient, body, gravity,
                                 surface_speed + fluid.flow.norm());
    const double linear =
        fluid.density_kgpm3 * fluid.linear_drag_mps * body.surface->area_m2 / body.inertia->mass_kg;
    most = std::max({most, swing * dt_s / kSwing, rate * dt_s / kFluidShare, linear * dt_s / kLinearShare,
                     speed * dt_s / (kWayShare * radius), turning * dt_s / kTurn});
  }
  return static_cast<int>(std::ceil(std::min(most, static_cast<double>(kMostStrokes))));
}

void drift(const Inertia& inertia, double dt_s, State& state) {
  state.X_WB.position += dt_s * state.velocity;
  Quat& R_WB = state.X_WB.rotation;
  R_WB = torqueFreeRotation(inertia, R_WB, angularVelocity(inertia, R_WB, state.angular_momentum), dt_s);
}

// The share of linear drag that is taken at the end of a kick: half, which is second order, but more where
// half would overshoot.
double implicitShare(const Mat6& linear, const Mat6& mass, double dt_s) {
  double stiffness = 0.0;
  for (Eigen::Index i = 0; i < 6; ++i) stiffness = std::max(stiffness, linear(i, i) / mass(i, i));
  stiffness *= 2.0 * dt_s;  // off-diagonal terms at most double it
  return stiffness > 2.0 ? 1.0 - 1.0 / stiffness : 0.5;
}

// Of a velocity or wrench in the body's frame, what its locks let it follow.
Mat6 freePart(const AxisLocks& locks, const Quat& R_WB) {
  const Mat3 R = R_WB.toRotationMatrix();
  Mat6 part = Mat6::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    part.block<3, 1>(0, i) = R.transpose() * locks.movingPart(R.col(i));
    part.block<3, 1>(3, 3 + i) = R.transpose() * locks.turningPart(R.col(i));
  }
  return part;
}

// Drag ties all directions together: had the locked ones their share of it, the free ones would be dragged as
// if the body gave way there.
void keepFreePart(const Mat6& part, BodyForces& forces) {
  forces.load = part * forces.load;
  for (Mat6* matrix : {&forces.added_mass, &forces.quadratic, &forces.linear})
    *matrix = part * *matrix * part;
  forces.quadratic_stream = part * forces.quadratic_stream;
  forces.linear_stream = part * forces.linear_stream;
}

void kick(const PushedBody& pushed, double t_s, double dt_s, ForceScratch& scratch, State& state) {
  const Inertia& inertia = *pushed.body.inertia;
  const Quat& R_WB = state.X_WB.rotation;
  Vec6 v;
  v.head<3>() = R_WB.conjugate() * state.velocity;
  v.tail<3>() = inertia.inverse_tensor_B * (R_WB.conjugate() * state.angular_momentum);
  BodyForces forces = bodyForces(pushed.environment, pushed.body, state.X_WB, v, t_s, scratch);
  forces.load.head<3>() += R_WB.conjugate() * pushed.contacts.force_N;
  forces.load.tail<3>() += R_WB.conjugate() * pushed.contacts.torque_Nm;
  const AxisLocks* locks = pushed.body.locks;
  if (locks != nullptr && locks->any()) keepFreePart(freePart(*locks, R_WB), forces);
  Vec6 momentum;  // gained
  if (forces.quadratic.isZero(0.0) && forces.linear.isZero(0.0) && forces.added_mass.isZero(0.0)) {
    momentum = dt_s * forces.load;
  } else {
    Mat6 mass = forces.added_mass;
    mass.topLeftCorner<3, 3>() += inertia.mass_kg * Mat3::Identity();
    mass.bottomRightCorner<3, 3>() += inertia.tensor_B;
    const double share = implicitShare(forces.linear, mass, dt_s);
    const Mat6 matrix = mass + dt_s * forces.quadratic + (dt_s * share) * forces.linear;
    // The gain U1 - U0, whose right side is the whole force: nothing is lost to cancellation.
    const Vec6 gain = matrix.llt().solve(dt_s * forces.total(v));
    momentum.head<3>() = inertia.mass_kg * gain.head<3>();
    momentum.tail<3>() = inertia.tensor_B * gain.tail<3>();
  }
  state.velocity += inertia.inverse_mass * (R_WB * momentum.head<3>());
  state.angular_momentum += R_WB * momentum.tail<3>();
}

// Of its energy of turning: what constant spin may have a body wrong on its way, which an impact then finds.
constexpr double kEnergyMissed = 1e-6;

// A body that is m radians from its orientation on its way carries a part m of its angular momentum along
// another of its axes, at worst that of its smallest moment.
bool turnsSteadily(const Inertia& inertia, const Quat& R_WB, const Vec3& omega, double dt_s) {
  const double miss = tumblingMiss(inertia, R_WB, omega, dt_s);
  return miss * miss * inertia.principal_moments[2] <= kEnergyMissed * inertia.principal_moments[0];
}

void findRotation(const PushedBody& pushed, const Pose& from, const Velocity& velocity, double dt_s,
                  EnvironmentFlight& flight) {
  const Inertia& inertia = *pushed.body.inertia;
  const Quat& R = flight.X_end.rotation;
  const Vec3 omega_end = angularVelocity(inertia, R, flight.angular_momentum_end);
  const double turn = std::max(velocity.angular.norm(), omega_end.norm()) * dt_s;
  if (!pushed.environment.isVacuum() && turn <= kLargestTurn &&
      turnsSteadily(inertia, from.rotation, velocity.angular, dt_s)) {
    flight.spin = rotationOf(R * from.rotation.conjugate()) / dt_s;
    return;
  }
  const Vec3 momentum = angularMomentum(inertia, from.rotation, velocity.angular);
  const Vec3 mean = 0.5 * (momentum + flight.angular_momentum_end);
  const Vec3 omega =
      pushed.environment.isVacuum()
          ? angularVelocity(inertia, from.rotation, mean)
          : spinOfEnergy(inertia, from.rotation, mean,
                         0.25 * dot(velocity.angular, momentum) + 0.5 * flight.turning_energy_end_J);
  flight.spin = omega;
  if (inertia.isIsotropic() || omega.isZero(0.0)) return;
  flight.tumbling = FreeRotation(inertia, from.rotation, omega);
  flight.spin = flight.tumbling.meanSpin(from.rotation, dt_s);
}

}  // namespace

EnvironmentFlight flyThroughEnvironment(const PushedBody& pushed, const Pose& X_WB, const Velocity& velocity,
                                        double t_s, double dt_s, ForceScratch& scratch) {
  const Inertia& inertia = *pushed.body.inertia;
  State state{X_WB, velocity.linear, angularMomentum(inertia, X_WB.rotation, velocity.angular)};
  const int strokes = strokesFor(pushed.environment, pushed.body, X_WB, velocity, dt_s);
  const double k = dt_s / strokes;
  drift(inertia, 0.5 * k, state);
  for (int i = 0; i < strokes; ++i) {
    kick(pushed, t_s + (i + 0.5) * k, k, scratch, state);
    drift(inertia, i + 1 < strokes ? k : 0.5 * k, state);
  }
  EnvironmentFlight flight{state.X_WB, state.velocity, state.angular_momentum};
  flight.turning_energy_end_J =
      0.5 *
      dot(state.angular_momentum, angularVelocity(inertia, state.X_WB.rotation, state.angular_momentum));
  flight.strokes = strokes;
  findRotation(pushed, X_WB, velocity, dt_s, flight);
  return flight;
}

}  // namespace carom
