#include "engine/simulation/midstep_rows.h"

#include <algorithm>

namespace carom {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

Vec3 relativeVelocity(const ContactRow& row, std::span<const ImpulseBody> bodies) {
  return bodies[at(row.b)].velocity.at(row.r_b) - bodies[at(row.a)].velocity.at(row.r_a);
}

// By how much turning may change the velocity at a contact in mid-step, m/s.
double turningChange(const Velocity& a, const Velocity& b, const Shape& shape_a, const Shape& shape_b,
                     double half_step_s) {
  const double spin_a = a.angular.norm();
  const double spin_b = b.angular.norm();
  const double slide = (b.linear - a.linear).norm();
  return half_step_s * (spin_a * (spin_a * shape_a.reach_m + 2.0 * slide) +
                        spin_b * (spin_b * shape_b.reach_m + 2.0 * slide));
}

Pose poseAfter(const Pose& X, const Velocity& v, double dt_s) {
  return Trajectory{0.0, X, v.linear, Vec3::Zero(), v.angular}.at(dt_s);
}

// The row where its point is in mid-step.
void takePlace(const SourcedRow& later, std::span<const ImpulseBody> bodies, double most_mps,
               SourcedRow& sourced) {
  const Vec3 before = relativeVelocity(sourced.row, bodies);
  const Vec3 after = relativeVelocity(later.row, bodies);
  Vec3 change = after - before;
  const double normal_change = later.row.n.dot(after) - sourced.row.n.dot(before);
  if (std::max(change.norm(), std::abs(normal_change)) > most_mps) return;  // another place than before
  ContactRow& row = sourced.row;
  const double coefficient = row.coefficient;
  row = later.row;
  setCoefficient(row, coefficient);
  sourced.off_middle_m = later.off_middle_m;
  row.lowest_speed = -normal_change;
  row.still_slip = -Vec2(row.t1.dot(change), row.t2.dot(change));
}

}  // namespace

void moveToMidStep(const RowRequest& request, const ShapePair& pair, const MidStep& mid,
                   const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                   std::span<const ImpulseBody> solver_bodies, std::span<SourcedRow> rows,
                   StepCounters& counters) {
  const Shape& a = shapes[at(pair.shapes.a)];
  const Shape& b = shapes[at(pair.shapes.b)];
  const Velocity& v_a = solver_bodies[at(request.row_a)].velocity;
  const Velocity& v_b = solver_bodies[at(request.row_b)].velocity;
  const double most = turningChange(v_a, v_b, a, b, mid.half_step_s);
  if (!(most > mid.noticed_mps)) return;
  RowRequest later = request;
  later.X_WA = poseAfter(request.X_WA, v_a, mid.half_step_s);
  later.X_WB = poseAfter(request.X_WB, v_b, mid.half_step_s);
  FeaturePair tracked = pair.tracked;
  const ClosestFeatures closest = closestFeatures(*a.part, later.X_WA, *b.part, later.X_WB, tracked);
  ++counters.distance_queries;
  if (!(closest.distance_m > 0.0)) return;
  later.closest = &closest;
  RememberedPoints now;
  for (const SourcedRow& row : rows) now.add(row.id);
  later.former = now.view();
  std::vector<SourcedRow> there;
  appendRows(later, pair, bodies, shapes, solver_bodies, there);
  for (SourcedRow& row : rows) {
    const auto same =
        std::find_if(there.begin(), there.end(), [&](const SourcedRow& s) { return s.id == row.id; });
    if (same != there.end()) takePlace(*same, solver_bodies, most, row);
  }
}

}  // namespace carom
