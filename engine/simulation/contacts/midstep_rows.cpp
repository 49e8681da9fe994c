#include "engine/simulation/contacts/midstep_rows.h"

#include <algorithm>

#include "engine/foundation/index.h"

namespace carom {
namespace {

// Radians a step: what turns farther has left the contact that it began the step with, or comes back to it.
constexpr double kFarTurn = 1.0;

// A body as it begins its step, and as its own spin has turned it in the middle.
struct Half {
  const Body& body;
  const HalfTurn& turn;
  const Shape& shape;

  Velocity velocity() const { return {body.velocity.linear, turn.spin}; }
  // By how much turning may change a point's velocity until then, seen from what slides past it.
  double change(double slide_mps, double half_step_s) const {
    const double spin = body.velocity.angular.norm();
    return half_step_s * spin * (spin * shape.reach_m + 2.0 * slide_mps) +
           (turn.spin - body.velocity.angular).norm() * shape.reach_m;
  }
  Pose pose(const Pose& X, double half_step_s) const {
    const Vec3 spin = turn.tumbles ? Vec3(Vec3::Zero()) : body.velocity.angular;
    Pose later = Trajectory{0.0, X, body.velocity.linear, Vec3::Zero(), spin}.at(half_step_s);
    if (turn.tumbles) later.rotation = turn.R_WB;
    return later;
  }
};

Vec3 relativeVelocity(const ContactRow& row, const Velocity& a, const Velocity& b) {
  return b.at(row.r_b) - a.at(row.r_a);
}

// The row where its point is in mid-step.
void takePlace(const SourcedRow& later, const Half& a, const Half& b, double most_mps, SourcedRow& sourced) {
  const Vec3 before = relativeVelocity(sourced.row, a.body.velocity, b.body.velocity);
  const Vec3 after = relativeVelocity(later.row, a.velocity(), b.velocity());
  Vec3 change = after - before;
  const double normal_change = dot(later.row.n, after) - dot(sourced.row.n, before);
  if (std::max(change.norm(), std::abs(normal_change)) > most_mps) return;  // another place than before
  ContactRow& row = sourced.row;
  const double coefficient = row.coefficient;
  row = later.row;
  setCoefficient(row, coefficient);
  sourced.off_middle_m = later.off_middle_m;
  row.lowest_speed = -normal_change;
  row.still_slip = -Vec2(dot(row.t1, change), dot(row.t2, change));
}

}  // namespace

bool moveToMidStep(const RowRequest& request, const ShapePair& pair, const MidStep& mid,
                   std::span<SourcedRow> rows, StepCounters& counters) {
  const auto halfOf = [&](int body, int shape) {
    return Half{mid.bodies[at(body)], mid.half_turns[at(body)], mid.shapes[at(shape)]};
  };
  const Half a = halfOf(pair.body_a, pair.shapes.a);
  const Half b = halfOf(pair.body_b, pair.shapes.b);
  const double slide = (b.body.velocity.linear - a.body.velocity.linear).norm();
  const double most = a.change(slide, mid.half_step_s) + b.change(slide, mid.half_step_s);
  if (!(most > mid.noticed_mps)) return true;
  RowRequest later = request;
  later.X_WA = a.pose(request.X_WA, mid.half_step_s);
  later.X_WB = b.pose(request.X_WB, mid.half_step_s);
  FeaturePair tracked = pair.tracked;
  const ClosestFeatures closest =
      closestFeatures(*a.shape.part, later.X_WA, *b.shape.part, later.X_WB, tracked);
  ++counters.distance_queries;
  counters.states_walked += closest.states;
  const double spin = std::max(a.body.velocity.angular.norm(), b.body.velocity.angular.norm());
  if (2.0 * mid.half_step_s * spin > kFarTurn && std::abs(closest.distance_m) > request.height_m)
    return false;
  if (!(closest.distance_m > 0.0)) return true;
  later.closest = &closest;
  RememberedPoints now;
  for (const SourcedRow& row : rows) now.add(row.id);
  later.former = now.view();
  std::vector<SourcedRow> there;
  appendRows(later, pair, mid.bodies, mid.shapes, mid.solver_bodies, there);
  for (SourcedRow& row : rows) {
    const auto same =
        std::find_if(there.begin(), there.end(), [&](const SourcedRow& s) { return s.id == row.id; });
    if (same != there.end()) takePlace(*same, a, b, most, row);
  }
  return true;
}

}  // namespace carom
