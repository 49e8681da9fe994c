#include "engine/simulation/events/step_record.h"

#include <algorithm>
#include <tuple>

#include "engine/foundation/index.h"
#include "engine/simulation/contacts/contact_rows.h"

namespace carom {
namespace {

// What resting bodies took last, at the points of contact that their poses still give.
void recordResting(const RecordedWorld& world, const ShapePair& pair, StepView& view) {
  const Body& a = world.bodies[at(pair.body_a)];
  const Body& b = world.bodies[at(pair.body_b)];
  if (a.moves() || b.moves() || pair.remembered.empty()) return;
  const RememberedPoints points(pair);
  const ContactManifold manifold = contactManifold(
      pair.closest,
      {*world.shapes[at(pair.shapes.a)].part, a.X_WB, *world.shapes[at(pair.shapes.b)].part, b.X_WB},
      pair.window, points.view(), groundOf(pair, world.bodies));
  for (const ManifoldPoint& point : manifold.view())
    for (const RememberedImpulse& remembered : pair.remembered) {
      if (remembered.id != point.id) continue;
      view.lasting.push_back({pair.body_a, pair.body_b, a.X_WB.inverse() * point.p_W,
                              b.X_WB.inverse() * point.p_W, point.n_W, point.gap_m,
                              world.substeps * world.table.impulseScale(pair) * remembered.impulse_W,
                              point.id, world.time_s});
    }
}

}  // namespace

void recordContacts(const RecordedWorld& world, const LastingContacts& contacts, StepView& view) {
  view.begin_s = world.time_s;
  view.lasting.clear();
  for (std::size_t i = 0; i < contacts.rows.size(); ++i) {
    const ContactRow& row = contacts.rows[i];
    const RowSource& source = contacts.sources[i];
    const Quat& R_WA = world.bodies[at(row.a)].X_WB.rotation;
    const Quat& R_WB = world.bodies[at(row.b)].X_WB.rotation;
    const Vec3 shift = -source.off_middle_m * row.n;  // what is shown stands halfway across the gap
    view.lasting.push_back({row.a, row.b, R_WA.conjugate() * (row.r_a + shift),
                            R_WB.conjugate() * (row.r_b + shift), row.n, source.gap_m,
                            world.substeps * rowImpulse(row, row.impulse), source.id, world.time_s});
  }
  for (const int place : world.table.all()) recordResting(world, world.table.pairs()[at(place)], view);
}

void recordCollision(const std::vector<Body>& bodies, const ContactCluster& cluster, double time_s,
                     StepView& view) {
  for (std::size_t i = 0; i < cluster.rows().size(); ++i) {
    const ContactRow& row = cluster.rows()[i];
    if (row.impulse.isZero(0.0)) continue;
    const int a = cluster.member(at(row.a)).body;
    const int b = cluster.member(at(row.b)).body;
    const Quat R_WA = bodies[at(a)].path.at(time_s).rotation;
    const Quat R_WB = bodies[at(b)].path.at(time_s).rotation;
    const RowSource& source = cluster.sources()[i];
    const Vec3 shift = -source.off_middle_m * row.n;
    view.collisions.push_back({a, b, R_WA.conjugate() * (row.r_a + shift),
                               R_WB.conjugate() * (row.r_b + shift), row.n, source.gap_m,
                               rowImpulse(row, row.impulse), source.id, view.begin_s + time_s});
  }
}

void recordPairs(const RecordedWorld& world, StepView& view) {
  view.candidates.clear();
  for (const Candidate& pair : world.table.candidates(world.bodies, world.shapes))
    view.candidates.push_back({pair.body_a, pair.body_b, pair.gap_m});
  std::stable_sort(view.candidates.begin(), view.candidates.end(),
                   [](const CandidateView& x, const CandidateView& y) {
                     return std::tie(x.body_a, x.body_b) < std::tie(y.body_a, y.body_b);
                   });
  view.swept.clear();
  for (const Proxy& proxy : world.table.proxies()) view.swept.push_back(proxy.bounds);
}

}  // namespace carom
