#include "engine/simulation/contacts/contact_rows.h"

#include <algorithm>
#include <cmath>

#include "engine/contact/approach.h"
#include "engine/contact/contact_id.h"
#include "engine/foundation/index.h"

namespace carom {
namespace {

constexpr double kTurningShare = 0.2;      // of the rest gap: an approach by turning that nobody notices
constexpr double kTurningGap = 0.5;        // of the rest gap: ending with less asks for more
constexpr double kNearlyElasticGap = 0.4;  // of the rest gap: the nearly elastic lie still from here upwards

// Where across the gap a pair's rows have their points, -1 on A's surface to 1 on B's. One point for both, so
// that an impulse turns them by opposite moments. What is round rolls by its radius: the point is on its
// surface, or where two of them miss their radii by the same share; halfway between two that are flat. On
// what cannot turn nothing is missed.
double leaningOf(const ShapePair& pair, const std::vector<Body>& bodies, const std::vector<Shape>& shapes) {
  const Ground ground = groundOf(pair, bodies);
  if (ground != Ground::kNone) return ground == Ground::kB ? -1.0 : 1.0;
  const double radius_a = shapes[at(pair.shapes.a)].part->radius_m;
  const double radius_b = shapes[at(pair.shapes.b)].part->radius_m;
  if (radius_a == radius_b) return 0.0;
  if (radius_a == 0.0) return 1.0;
  if (radius_b == 0.0) return -1.0;
  return (radius_a - radius_b) / (radius_a + radius_b);
}

// How far beside their true places the points of two that are flat may be. What is round has them under its
// centres.
double slackOf(const ShapePair& pair, const std::vector<Shape>& shapes) {
  const bool flat =
      shapes[at(pair.shapes.a)].part->radius_m == 0.0 && shapes[at(pair.shapes.b)].part->radius_m == 0.0;
  return flat ? tolerance::kRestBand * pair.window.rest : 0.0;
}

// Two parts that travel `dt_s` with these velocities from these poses.
struct PairTravel {
  Pose X_WA;
  Velocity a;
  Velocity momentum_a;  // now
  Pose X_WB;
  Velocity b;
  Velocity momentum_b;
  double dt_s = 0.0;
  bool all = false;
};

// By how much, m/s, a pair's rows must part faster; 0 when it stays in the window, or nothing turns
// noticeably.
double turningSpeed(const ShapePair& pair, const std::vector<Shape>& shapes, const PairTravel& travel,
                    StepCounters& counters) {
  const Shape& a = shapes[at(pair.shapes.a)];
  const Shape& b = shapes[at(pair.shapes.b)];
  const double dt = travel.dt_s;
  const double closing = mostClosing({travel.a, a.reach_m}, {travel.b, b.reach_m}, dt);
  if (closing <= kTurningShare * pair.window.rest) return 0.0;
  const Trajectory path_a{0.0, travel.X_WA, travel.a.linear, Vec3::Zero(), travel.a.angular};
  const Trajectory path_b{0.0, travel.X_WB, travel.b.linear, Vec3::Zero(), travel.b.angular};
  FeaturePair tracked = pair.tracked;
  const Pose end_a = path_a.at(dt);
  const Pose end_b = path_b.at(dt);
  const ClosestFeatures closest = closestFeatures(*a.part, end_a, *b.part, end_b, tracked);
  counters.addQuery(closest.states);
  const double gap = closest.distance_m;
  const Vec3 arm_a = travel.X_WA.rotation * (end_a.inverse() * closest.p_A_W);
  const Vec3 arm_b = travel.X_WB.rotation * (end_b.inverse() * closest.p_B_W);
  const double speed_now = dot(closest.n_W, travel.momentum_b.at(arm_b) - travel.momentum_a.at(arm_a));
  if (!travel.all && speed_now < -pair.collision_speed_mps) return 0.0;
  const double wanted = pair.window.rest * (1.0 - tolerance::kRestBand);
  return gap < kTurningGap * pair.window.rest ? (wanted - gap) / dt : 0.0;
}

}  // namespace

Ground groundOf(const ShapePair& pair, const std::vector<Body>& bodies) {
  const bool a_yields = bodies[at(pair.body_a)].yields();
  if (a_yields == bodies[at(pair.body_b)].yields()) return Ground::kNone;
  return a_yields ? Ground::kB : Ground::kA;
}

void appendRows(const RowRequest& request, const ShapePair& pair, const std::vector<Body>& bodies,
                const std::vector<Shape>& shapes, std::span<const ImpulseBody> solver_bodies,
                std::vector<SourcedRow>& rows) {
  CollisionWindow window = pair.window;
  window.manifold = std::max(window.manifold, request.height_m);
  const ContactManifold manifold = contactManifold(
      *request.closest,
      {*shapes[at(pair.shapes.a)].part, request.X_WA, *shapes[at(pair.shapes.b)].part, request.X_WB}, window,
      request.former, groundOf(pair, bodies));
  const double leaning = leaningOf(pair, bodies, shapes);
  const double slack_m = slackOf(pair, shapes);
  const Material& material_a = bodies[at(pair.body_a)].material;
  const Material& material_b = bodies[at(pair.body_b)].material;
  const Friction friction = combinedFriction(material_a, material_b);
  const TurningResistance resistance = combinedResistance(material_a, material_b);
  const auto append = [&](const ManifoldPoint& point) {
    const double off_middle_m = 0.5 * point.gap_m * leaning;
    SourcedRow& sourced = rows.emplace_back();
    sourced.pair = request.pair;
    sourced.id = point.id;
    sourced.gap_m = point.gap_m;
    sourced.off_middle_m = off_middle_m;
    sourced.slack_m = slack_m;
    ContactRow& row = sourced.row;
    row.a = request.row_a;
    row.b = request.row_b;
    row.n = point.n_W;
    const Vec3 p_W = point.p_W + off_middle_m * point.n_W;
    row.r_a = p_W - request.X_WA.position;
    row.r_b = p_W - request.X_WB.position;
    row.friction = friction;
    row.resistance = resistance;
    prepareRow(row, solver_bodies);
    if (isUnanswered(solver_bodies[at(row.a)], solver_bodies[at(row.b)], row.normal_response.x()))
      rows.pop_back();
  };
  for (const ManifoldPoint& point : manifold.view()) append(point);
  if (!request.struck) return;
  // Of equally deep corners the manifold may have dropped the one that came in.
  const Vec3 struck = 0.5 * (request.closest->p_A_W + request.closest->p_B_W);
  const bool known = std::any_of(
      manifold.view().begin(), manifold.view().end(),
      [&](const ManifoldPoint& point) { return (point.p_W - struck).norm() <= kSamePlace * window.rest; });
  if (!known && manifold.count < ContactManifold::kMaxPoints)
    append({struck, request.closest->n_W, request.closest->distance_m,
            contactId(request.closest->features, PointRole::kClosest), request.closest->features});
}

double workOfForces(const ShapePair& pair, const std::vector<Body>& bodies, double begin_s, double end_s) {
  const Body& a = bodies[at(pair.body_a)];
  const Body& b = bodies[at(pair.body_b)];
  if (a.travel != Travel::kDriven && b.travel != Travel::kDriven) return 0.0;
  double work_J = 0.0;
  const auto add = [&](const Body& body, const RememberedImpulse& acting, double sign, const Vec3& arm) {
    if (body.travel != Travel::kDriven || body.was_stopped) return;
    const double middle_s = 0.5 * (begin_s + end_s);
    const Velocity mean{body.path.velocityAt(middle_s), body.path.angularVelocityAt(middle_s)};
    work_J +=
        sign * (end_s - begin_s) * (dot(acting.force_W, mean.at(arm)) + dot(acting.torque_W, mean.angular));
  };
  for (const RememberedImpulse& acting : pair.remembered) {
    add(a, acting, 1.0, acting.arm_a);
    add(b, acting, -1.0, acting.arm_b);
  }
  return work_J;
}

Friction combinedFriction(const Material& a, const Material& b) {
  return {std::sqrt(a.static_friction * b.static_friction),
          std::sqrt(a.dynamic_friction * b.dynamic_friction)};
}

double combinedRestitution(const Material& a, const Material& b) {
  return std::max(a.restitution, b.restitution);
}

TurningResistance combinedResistance(const Material& a, const Material& b) {
  return {std::sqrt(a.rolling_resistance_m * b.rolling_resistance_m),
          std::sqrt(a.spinning_resistance_m * b.spinning_resistance_m)};
}

GapSpeeds gapSpeeds(double gap_m, const ShapePair& pair, double dt_s, bool presses) {
  const double rest = std::abs(pair.room) * pair.window.rest;
  const double band = tolerance::kRestBand * rest;
  if (gap_m > rest + band) {
    const double closing = (rest + band - gap_m) / dt_s;
    return {(presses ? tolerance::kGapGain : 1.0) * closing, closing};
  }
  const double lowest = pair.restitution > tolerance::kNearlyElastic ? kNearlyElasticGap * rest : rest - band;
  const double missing = lowest - gap_m;
  if (missing <= 0.0 || pair.room < 0.0) return {};
  return {0.0, std::min(missing / dt_s, tolerance::kGapSpeed)};
}

bool raiseForTurning(const PathBounds& bounds, const ShapePair& pair, std::span<const ImpulseBody> paths,
                     std::span<ContactRow> rows, StepCounters& counters) {
  if (rows.empty()) return false;
  const Body& a = bounds.bodies[at(pair.body_a)];
  const Body& b = bounds.bodies[at(pair.body_b)];
  const Pose X_WA = a.path.at(bounds.time_s);
  const Pose X_WB = b.path.at(bounds.time_s);
  const PairTravel travel{.X_WA = X_WA,
                          .a = paths[at(rows.front().a)].velocity,
                          .momentum_a = a.velocityAt(bounds.time_s, X_WA.rotation),
                          .X_WB = X_WB,
                          .b = paths[at(rows.front().b)].velocity,
                          .momentum_b = b.velocityAt(bounds.time_s, X_WB.rotation),
                          .dt_s = bounds.rest_of_step_s,
                          .all = bounds.all};
  const double speed = turningSpeed(pair, bounds.shapes, travel, counters);
  for (ContactRow& row : rows) row.lowest_speed += speed;
  return speed > 0.0;
}

}  // namespace carom
