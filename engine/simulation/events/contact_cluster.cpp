#include "engine/simulation/events/contact_cluster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/foundation/index.h"
#include "engine/response/collision.h"
#include "engine/response/conjugate_sweeps.h"
#include "engine/response/standing_solver.h"
#include "engine/response/sweeps/energy_bound.h"
#include "engine/response/sweeps/no_room.h"
#include "engine/response/sweeps/principal_pivoting.h"
#include "engine/response/sweeps/turning_resistance.h"
#include "engine/simulation/contacts/carried_path.h"
#include "engine/simulation/contacts/internal_edges.h"
#include "engine/simulation/contacts/path_change.h"

namespace carom {
namespace {

// Of the safe residual: what sweeps over few rows leave over more of is solved at once, and to this.
constexpr double kFewRowsShare = 1e-3;
// Sweeps between two looks at which bodies the impulses have reached.
constexpr int kSweepsARound = 4;
// Sweeps, at least, once the impulses have reached all whom they reach.
constexpr int kFineSweeps = 20;
// Sweeps of one solve of a small cluster, at most.
constexpr int kMostSweeps = 80;
// A cluster of more rows is large: most of them are quiet, and only those that are not are visited.
constexpr std::size_t kCrowdRows = 100;
// Sweeps of one solve of a large cluster, at most: what they leave over is left to the next step.
constexpr int kCrowdSweeps = 20;
// Rest gaps a step: impulses and forces go on only to bodies that they move by more, and by more still the
// larger a large cluster has grown.
constexpr double kCrowdRestGaps = 2.0;
// Of the approach: the residual to which small clusters are solved.
constexpr double kShareOfApproach = 1e-10;
// Rows visited at that residual, at most. Then the safe residual is enough, which cannot use up much of the
// gap within a step.
constexpr long kCarefulVisits = 1000;
// Of the safe residual: the one to which the paths of small clusters are solved.
constexpr double kPathShare = 0.01;
// Of the resting mode's speed: forces that make less of it in a step wake no body.
constexpr double kWakingShare = 0.1;

// A remembered force, which is the one on B, acts on one of the two bodies: on A for a negative time.
void act(const RememberedImpulse& acting, const Vec3& arm, double dt_s, ImpulseBody& body) {
  body.apply(dt_s * acting.force_W, arm);
  body.turn(dt_s * acting.torque_W);
}

}  // namespace

void ContactCluster::begin(int pair, const ClosestFeatures& closest, double time_s) {
  clear(time_s);
  addEvent(pair, closest);
}

void ContactCluster::begin(int pair, double time_s) {
  clear(time_s);
  addEvent(pair, look(pair));
}

void ContactCluster::addEvent(int pair, const ClosestFeatures& closest) {
  collided_.insert(collided_.end(), sources_.begin(), sources_.end());
  sources_.clear();
  rows_.clear();
  event_pairs_.push_back(pair);
  pair_seen_[at(pair)] = number_;
  closest_[at(pair)] = closest;
  addPair(pair, closest);
  for (const int body : {table_.pairs()[at(pair)].body_a, table_.pairs()[at(pair)].body_b})
    members_[at(join(body))].struck = true;
}

bool ContactCluster::hasRoomFor(const ShapePair& pair) const {
  const auto joined = [this](int body) {
    return bodies_[at(body)].yields() && body_joined_[at(body)] == number_;
  };
  return !joined(pair.body_a) && !joined(pair.body_b) && collided_.size() + sources_.size() < kCrowdRows;
}

void ContactCluster::clear(double time_s) {
  ++number_;
  body_joined_.resize(bodies_.size(), 0);
  body_member_.resize(bodies_.size(), 0);
  pair_joined_.resize(table_.pairs().size(), 0);
  pair_seen_.resize(table_.pairs().size(), 0);
  closest_.resize(table_.pairs().size());
  pair_released_.resize(table_.pairs().size(), 0);
  time_s_ = time_s;
  stage_ = Stage::kMomentum;
  stops_short_ = false;
  members_.clear();
  momentum_.clear();
  ends_.clear();
  planned_ends_.clear();
  pressed_.clear();
  bends_.clear();
  paths_.clear();
  solve_before_.clear();
  event_pairs_.clear();
  collided_.clear();
  sources_.clear();
  rows_.clear();
}

const ClosestFeatures* ContactCluster::closestSeen(int pair, double time_s) const {
  const bool seen = time_s == time_s_ && at(pair) < pair_seen_.size() && pair_seen_[at(pair)] == number_;
  return seen ? &closest_[at(pair)] : nullptr;
}

const ClosestFeatures& ContactCluster::look(int index) {
  if (pair_seen_[at(index)] == number_) return closest_[at(index)];
  pair_seen_[at(index)] = number_;
  ShapePair& pair = table_.pairs()[at(index)];
  ClosestFeatures& closest = closest_[at(index)];
  closest = closestFeatures(*shapes_[at(pair.shapes.a)].part, bodies_[at(pair.body_a)].path.at(time_s_),
                            *shapes_[at(pair.shapes.b)].part, bodies_[at(pair.body_b)].path.at(time_s_),
                            pair.tracked);
  counters_.addQuery(closest.states);
  return closest;
}

int ContactCluster::join(int index) {
  if (body_joined_[at(index)] == number_) return body_member_[at(index)];
  body_joined_[at(index)] = number_;
  body_member_[at(index)] = static_cast<int>(members_.size());
  const Body& body = bodies_[at(index)];
  if (!body.is_static && !body.active) table_.activate(index, bodies_, settings_);
  Member member;
  member.body = index;
  member.expanded = !body.yields();
  if (!body.is_static) {
    member.momentum_before = body.velocityAt(time_s_);
    member.path_before = {body.path.velocityAt(time_s_) + 0.5 * restOfStep() * body.path.acceleration,
                          body.path.angularVelocityAt(time_s_)};
  }
  members_.push_back(member);
  momentum_.push_back(body.impulseBody(body.path.at(time_s_), member.momentum_before));
  paths_.push_back(momentum_.back());
  paths_.back().velocity = member.path_before;
  if (body.travel == Travel::kHeld) fixPath(paths_.size() - 1);
  ends_.push_back(momentum_.back());
  const Velocity gain = gainedByForces(member, member.momentum_before);
  ends_.back().velocity = {member.momentum_before.linear + gain.linear,
                           member.momentum_before.angular + gain.angular};
  planned_ends_.push_back(ends_.back().velocity);
  pressed_.push_back(0);
  bends_.push_back(0);
  solve_before_.push_back(stageBodies().back().velocity);
  return body_member_[at(index)];
}

// Its momentum may change, its path may not.
void ContactCluster::fixPath(std::size_t i) {
  paths_[i].inverse_mass = 0.0;
  paths_[i].inverse_tensor.setZero();
}

Velocity ContactCluster::gainedByForces(const Member& member, const Velocity& velocity) const {
  const Body& body = bodies_[at(member.body)];
  if (body.is_static || member.stops) return {};
  Velocity gain{restOfStep() * body.acceleration, Vec3::Zero()};
  if (body.is_kinematic) {
    if (body.travel == Travel::kDriven) gain.angular = restOfStep() * body.path.spin_change.rate;
    return gain;
  }
  gain.angular =
      body.spinGained(body.inertia, body.path.at(time_s_).rotation, velocity.angular, restOfStep());
  return gain;
}

// What forces make of member i by the end of the step, after the collision. Air and fluids resist the
// velocity that it has now.
void ContactCluster::findEnd(std::size_t i) {
  const Member& member = members_[i];
  const Body& body = bodies_[at(member.body)];
  const bool flies = body.yields() && (body.travel == Travel::kBallistic || body.travel == Travel::kCarried);
  const bool anew = flies && !planner_.isVacuum() && momentumChanged(i);
  const Velocity gain = anew ? planner_.gainedFrom(member.body, body, time_s_, momentum(i))
                             : gainedByForces(member, momentum(i));
  ends_[i].velocity = {momentum(i).linear + gain.linear, momentum(i).angular + gain.angular};
  if (!anew || body.travel == Travel::kBallistic) return;
  for (const int p : table_.pairsOf(member.body)) {
    const ShapePair& pair = table_.pairs()[at(p)];
    const bool on_a = pair.body_a == member.body;
    for (const RememberedImpulse& acting : pair.remembered)
      act(acting, on_a ? acting.arm_a : acting.arm_b, on_a ? -restOfStep() : restOfStep(), ends_[i]);
  }
}

bool ContactCluster::forcesChanged(std::size_t i) const {
  const Body& body = bodies_[at(members_[i].body)];
  const double change = (ends_[i].velocity.linear - planned_ends_[i].linear).norm() +
                        (ends_[i].velocity.angular - planned_ends_[i].angular).norm() * body.radius_m;
  return change > (body.resting ? kWakingShare * tolerance::kRestSpeed : 0.0);
}

double ContactCluster::lowestSpeed(const SourcedRow& sourced) const {
  const ShapePair& pair = table_.pairs()[at(sourced.pair)];
  const GapSpeeds bounds = gapSpeeds(sourced.gap_m, pair, restOfStep());
  if (stage_ == Stage::kPath) return bounds.path;
  if (sourced.pair == presentEvent()) return 0.0;
  const bool in_window = sourced.gap_m <= pair.window.ceiling;
  return in_window ? std::max(bounds.momentum, -kSlowShare * pair.collision_speed_mps) : bounds.momentum;
}

void ContactCluster::addPair(int index, const ClosestFeatures& closest) {
  pair_joined_[at(index)] = number_;
  const ShapePair& pair = table_.pairs()[at(index)];
  const int a = join(pair.body_a);
  const int b = join(pair.body_b);
  if (!givesWay(a) && !givesWay(b)) return;
  const std::size_t first = sources_.size();
  const RememberedPoints remembered(pair);
  appendRows({.pair = index,
              .row_a = a,
              .row_b = b,
              .closest = &closest,
              .X_WA = bodies_[at(pair.body_a)].path.at(time_s_),
              .X_WB = bodies_[at(pair.body_b)].path.at(time_s_),
              .former = remembered.view(),
              .struck = index == presentEvent()},
             pair, bodies_, shapes_, stageBodies(), sources_);
  const double highest =
      std::max(closest.distance_m, index == presentEvent() ? pair.window.ceiling : pair.window.manifold);
  std::erase_if(sources_, [&](const SourcedRow& s) { return s.pair == index && s.gap_m > highest; });
  for (std::size_t i = first; i < sources_.size(); ++i) {
    rows_.push_back(sources_[i].row);
    rows_.back().lowest_speed = lowestSpeed(sources_[i]);
    if (stage_ == Stage::kMomentum) rows_.back().resistance = {};  // it belongs to lasting contact
  }
  if (stage_ == Stage::kSupport) takeOverForces(first, sources_.size() - first);
}

// Whether the contact of a pair that has been looked at is one with an internal edge.
bool ContactCluster::isInternal(int index) {
  const auto placed = [&](int i) {
    const ShapePair& pair = table_.pairs()[at(i)];
    return PlacedPair{pair, look(i), bodies_[at(pair.body_a)].path.at(time_s_),
                      bodies_[at(pair.body_b)].path.at(time_s_)};
  };
  const PlacedPair contact = placed(index);
  if (!isAtEdges(contact, shapes_)) return false;
  for (const int body : {contact.pair.body_a, contact.pair.body_b}) {
    if (bodies_[at(body)].is_static) continue;
    for (const int other : table_.pairsOf(body))
      if (other != index && look(other).distance_m <= table_.pairs()[at(other)].window.manifold &&
          passesEdge(contact, placed(other), restOfStep(), bodies_, shapes_))
        return true;
  }
  return false;
}

void ContactCluster::expand(int body) {
  for (int p : table_.pairsOf(body)) {
    if (pair_joined_[at(p)] == number_) continue;
    pair_joined_[at(p)] = number_;
    const ClosestFeatures& closest = look(p);
    if (closest.distance_m <= table_.pairs()[at(p)].window.manifold && !isInternal(p)) addPair(p, closest);
  }
  if (stage_ == Stage::kSupport) releaseDistant(body);
}

// Whether contacts have joined.
bool ContactCluster::expandMoved(double noticeable_mps) {
  const std::size_t rows = rows_.size();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].expanded) continue;
    const Velocity& now = stageBodies()[i].velocity;
    const Body& body = bodies_[at(members_[i].body)];
    const double change = (now.linear - solve_before_[i].linear).norm() +
                          (now.angular - solve_before_[i].angular).norm() * body.radius_m;
    if (change <= noticeable_mps) continue;
    members_[i].expanded = true;
    expand(members_[i].body);
  }
  return rows_.size() > rows;
}

// Whether the bodies' spheres say that the pair could be in the window.
bool ContactCluster::isNear(const ShapePair& pair) const {
  const Body& a = bodies_[at(pair.body_a)];
  const Body& b = bodies_[at(pair.body_b)];
  return (b.path.positionAt(time_s_) - a.path.positionAt(time_s_)).norm() <=
         a.radius_m + b.radius_m + pair.window.ceiling;
}

// Bodies may meet several others at the same instant and speed (a ball two that touch): one collision, so
// that its outcome does not depend on who is asked first.
void ContactCluster::joinSimultaneous(double approach_mps) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!bodies_[at(members_[i].body)].yields()) continue;
    for (int p : table_.pairsOf(members_[i].body)) {
      const ShapePair& pair = table_.pairs()[at(p)];
      if (pair_joined_[at(p)] == number_ || !isNear(pair)) continue;
      pair_joined_[at(p)] = number_;
      const Body& a = bodies_[at(pair.body_a)];
      const Body& b = bodies_[at(pair.body_b)];
      const ClosestFeatures& closest = look(p);
      const Vec3 relative = b.velocityAt(time_s_).at(closest.p_B_W - b.path.positionAt(time_s_)) -
                            a.velocityAt(time_s_).at(closest.p_A_W - a.path.positionAt(time_s_));
      if (closest.distance_m <= pair.window.ceiling && sameApproach(dot(closest.n_W, relative), approach_mps))
        addPair(p, closest);
      else
        pair_joined_[at(p)] = 0;  // it may still join as a support
    }
  }
}

double ContactCluster::safeResidual() const {
  return carom::safeResidual(table_.pairs()[at(presentEvent())].window, settings_.step_s);
}

double ContactCluster::noticeableSpeed() const {
  if (!isCrowd() || stage_ == Stage::kPath) return safeResidual();
  const double crowds = static_cast<double>(rows_.size()) / static_cast<double>(kCrowdRows);
  return kCrowdRestGaps * crowds * crowds * table_.pairs()[at(presentEvent())].window.rest / settings_.step_s;
}

bool ContactCluster::isCrowd() const {
  return rows_.size() > kCrowdRows;
}

int ContactCluster::mostSweeps() const {
  return isCrowd() ? kCrowdSweeps : kMostSweeps;
}

void ContactCluster::solveSpreading(double careful_mps) {
  // Each round stops a member, or is the last.
  while (!sweepSpreading(careful_mps)) {
    const std::vector<int> without_room = drivenWithoutRoom();
    if (without_room.empty()) return;
    stopDriven(without_room);
  }
}

// Members that are driven, and leave the others no room.
std::vector<int> ContactCluster::drivenWithoutRoom() const {
  const bool any = std::any_of(members_.begin(), members_.end(), [this](const Member& m) {
    return bodies_[at(m.body)].travel == Travel::kDriven && !m.stops;
  });
  if (!any || stops_short_) return {};
  const double safe_mps = safeResidual();
  const bool misses = std::any_of(rows_.begin(), rows_.end(), [&](const ContactRow& row) {
    return -rowMiss(row, stageBodies()).x() > safe_mps;
  });
  if (!misses) return {};
  return leavingNoRoom(rows_, stageBodies(), stage_ != Stage::kPath);
}

// They stay where they are from now on, and the rows begin anew.
void ContactCluster::stopDriven(std::span<const int> members) {
  undoLoads(rows_, stageBodies());
  for (const int i : members) {
    Member& member = members_[at(i)];
    member.stops = true;
    member.momentum_before = member.path_before = {};
    momentum_[at(i)].velocity = ends_[at(i)].velocity = paths_[at(i)].velocity = {};
    planned_ends_[at(i)] = solve_before_[at(i)] = {};
  }
}

// Whether it has converged.
bool ContactCluster::sweepSpreading(double careful_mps) {
  const bool friction = stage_ != Stage::kPath;
  const double safe = safeResidual();
  long visits = 0;
  bool resumes = false;
  bool solved_at_once = false;
  bool unseen = false;   // whom the solution at once reaches has not been looked at
  bool reached = false;  // all whom the impulses reach have joined
  for (int sweeps = 0; visits < kCarefulVisits || sweeps < mostSweeps() || unseen;) {
    const double enough = visits < kCarefulVisits ? std::min(careful_mps, safe) : safe;
    const int fine_sweeps =
        std::max(kFineSweeps, static_cast<int>(kCarefulVisits) / std::max(1, static_cast<int>(rows_.size())));
    const bool fine = reached && !isCrowd();
    const SolverSettings settings{.sweeps = fine ? fine_sweeps : kSweepsARound,
                                  .residual_mps = enough,
                                  .friction = friction,
                                  .resumes = resumes};
    const SolverReport report = fine ? solveContactsFinely(rows_, stageBodies(), settings)
                                     : solveContacts(rows_, stageBodies(), settings);
    resumes = !fine;
    sweeps += report.sweeps;
    visits += report.visits;
    visits_ += report.visits;
    const bool grew = !isExhausted() && expandMoved(noticeableSpeed());
    reached = !grew;
    const bool leaves_much = report.residual_mps > kFewRowsShare * safe;
    if (fine && !grew && leaves_much && !solved_at_once && rows_.size() <= kMostPivotedRows) {
      solved_at_once = unseen = true;
      solveAtOnce(kFewRowsShare * safe);
      continue;
    }
    unseen = false;
    if (!grew && report.residual_mps <= enough) return true;
  }
  return false;
}

// Few rows that sweeps do not bring to rest: what lies between bodies a thousand times as heavy.
void ContactCluster::solveAtOnce(double enough_mps) {
  if (stage_ == Stage::kPath) return pivotPaths();
  const SolverSettings settings{.sweeps = kFineSweeps, .residual_mps = enough_mps};
  visits_ += solveStandingContacts(rows_, stageBodies(), settings).visits;
}

// From where the paths began.
void ContactCluster::pivotPaths() {
  std::vector<ContactRow> rows = rows_;
  for (ContactRow& row : rows) row.impulse.setZero();
  std::vector<ImpulseBody> before = paths_;
  for (std::size_t i = 0; i < before.size(); ++i) before[i].velocity = solve_before_[i];
  std::vector<ImpulseBody> paths = before;
  const auto size = static_cast<Eigen::Index>(rows.size());
  if (!pivotRows(rows, paths, Eigen::VectorXd::Constant(size, kPathShare * safeResidual())) ||
      !staysNear(before, paths))
    return;
  rows_ = rows;
  paths_ = paths;
}

// Whether that leads them no farther than standing still would. Else they are left as they were: the search
// finds where they meet, and they are led apart there.
bool ContactCluster::solvePaths() {
  std::vector<Velocity> led;
  for (const ImpulseBody& path : paths_) led.push_back(path.velocity);
  solveSpreading(kPathShare * safeResidual());
  PathChange change;
  for (std::size_t i = 0; i < paths_.size(); ++i) change.add(paths_[i], solve_before_[i], paths_[i].velocity);
  if (change.staysNear()) return true;
  led.insert(led.end(), solve_before_.begin() + static_cast<std::ptrdiff_t>(led.size()), solve_before_.end());
  for (std::size_t i = 0; i < paths_.size(); ++i) paths_[i].velocity = led[i];
  return false;
}

std::vector<double> ContactCluster::findRestitution() {
  std::vector<double> restitution(rows_.size(), 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ShapePair& pair = table_.pairs()[at(sources_[i].pair)];
    if (rowVelocity(rows_[i], momentum_).x() >= -pair.collision_speed_mps) continue;
    restitution[i] =
        combinedRestitution(bodies_[at(pair.body_a)].material, bodies_[at(pair.body_b)].material);
    members_[at(rows_[i].a)].collided = members_[at(rows_[i].b)].collided = true;
  }
  return restitution;
}

void ContactCluster::collide(bool spreads) {
  double approach = 0.0;
  for (const ContactRow& row : rows_) approach = std::min(approach, rowVelocity(row, momentum_).x());
  if (!spreads && approach < 0.0) joinSimultaneous(approach);
  std::vector<double> restitution = findRestitution();
  if (approach >= 0.0) return;
  const bool elastic = std::any_of(restitution.begin(), restitution.end(), [](double e) { return e > 0.0; });
  if (spreads) {
    solveSpreading(kShareOfApproach * -approach);
    takeBackGain(rows_, momentum_);
    if (!elastic && rows_.size() > 1) return;  // one point is followed through
    startAgain();
    restitution = findRestitution();
  }
  carom::collide(rows_, momentum_, restitution);
}

// The compression has found whom the collision reaches. With restitution it starts from the velocities
// before, between those in contact.
void ContactCluster::startAgain() {
  for (std::size_t i = 0; i < members_.size(); ++i) momentum_[i].velocity = members_[i].momentum_before;
  std::erase_if(sources_, [&](const SourcedRow& s) {
    return s.pair != presentEvent() && s.gap_m > table_.pairs()[at(s.pair)].window.ceiling;
  });
  rows_.clear();
  for (const SourcedRow& sourced : sources_) rows_.push_back(sourced.row);
}

// Whether a point comes in so fast that it has its own time of impact; in the window, without restitution, it
// is stopped with the others.
bool ContactCluster::collidesLater(const ContactRow& row, const SourcedRow& sourced) const {
  const ShapePair& pair = table_.pairs()[at(sourced.pair)];
  if (rowVelocity(row, momentum_).x() >= -pair.collision_speed_mps) return false;
  return pair.restitution > 0.0 || sourced.gap_m > pair.window.ceiling;
}

double ContactCluster::workOfCollision() const {
  double work_J = 0.0;
  for (const ContactRow& row : rows_) {
    const Vec3 impulse = rowImpulse(row, row.impulse);
    if (bodies_[at(members_[at(row.a)].body)].is_kinematic)
      work_J += dot(impulse, momentum_[at(row.a)].velocity.at(row.r_a));
    if (bodies_[at(members_[at(row.b)].body)].is_kinematic)
      work_J -= dot(impulse, momentum_[at(row.b)].velocity.at(row.r_b));
  }
  return work_J;
}

// Ends the forces between the bodies of a pair, both members.
void ContactCluster::releaseForces(int index) {
  pair_released_[at(index)] = number_;
  const ShapePair& pair = table_.pairs()[at(index)];
  counters_.work_J -= workOfForces(pair, bodies_, time_s_, settings_.step_s);
  const int member_a = join(pair.body_a);
  const int member_b = join(pair.body_b);
  ImpulseBody& a = ends_[at(member_a)];
  ImpulseBody& b = ends_[at(member_b)];
  for (const RememberedImpulse& acting : pair.remembered) {
    act(acting, acting.arm_a, restOfStep(), a);
    act(acting, acting.arm_b, -restOfStep(), b);
  }
}

// Ends the forces of a body's pairs whose contact is over, but that still press each other. Before the others
// are solved: what such a force was balanced by must not be left to act alone.
void ContactCluster::releaseDistant(int body) {
  for (int p : table_.pairsOf(body)) {
    ShapePair& pair = table_.pairs()[at(p)];
    if (pair.remembered.empty() || pair_released_[at(p)] == number_) continue;
    releaseForces(p);
    pair.remembered.clear();
  }
}

// The forces that act between the bodies of a pair, whose rows these are, become the rows' own; rows of fast
// approaches, and of fast partings where restitution makes them bounce, give no support.
void ContactCluster::takeOverForces(std::size_t first, std::size_t count) {
  if (count == 0) return;
  const ShapePair& pair = table_.pairs()[at(sources_[first].pair)];
  releaseForces(sources_[first].pair);
  for (std::size_t k = first; k < first + count; ++k) {
    ContactRow& row = rows_[k];
    row.impulse.setZero();
    row.torque.setZero();
    row.lowest_speed = -std::numeric_limits<double>::max();
    if (collidesLater(row, sources_[k])) continue;
    if (pair.restitution > 0.0 && rowVelocity(row, momentum_).x() > pair.collision_speed_mps) continue;
    for (const RememberedImpulse& acting : pair.remembered) {
      if (acting.id != sources_[k].id) continue;
      row.impulse = inRowFrame(row, restOfStep() * acting.force_W);
      row.impulse.x() = std::max(0.0, row.impulse.x());
      row.torque = inRowFrame(row, restOfStep() * acting.torque_W);
    }
    applyLoad(row, ends_);
    row.lowest_speed = gapSpeeds(sources_[k].gap_m, pair, restOfStep(), row.impulse.x() > 0.0).momentum;
  }
}

// Points of the event's pair that press, but that the manifold of this instant does not show (of five corners
// it keeps four): else two corners struck in turn would each undo what holds the other.
void ContactCluster::recallPoints(int event_pair) {
  const auto of_event = [&](const SourcedRow& s) { return s.pair == event_pair; };
  const auto begin = std::ranges::find_if(sources_, of_event);
  if (begin == sources_.end()) return;
  const auto first = static_cast<std::size_t>(begin - sources_.begin());
  std::size_t end = first;
  while (end < sources_.size() && of_event(sources_[end])) ++end;
  const ShapePair& pair = table_.pairs()[at(event_pair)];
  for (const RememberedImpulse& acting : pair.remembered) {
    if (end - first >= ContactManifold::kMaxPoints) break;
    const std::span<const SourcedRow> shown(&sources_[first], end - first);
    const bool known = std::ranges::any_of(shown, [&](const SourcedRow& s) { return s.id == acting.id; });
    if (acting.force_W.isZero(0.0) || known) continue;
    SourcedRow recalled = sources_[first];
    recalled.id = acting.id;
    recalled.gap_m = pair.window.rest;  // held as it is
    recalled.row.r_a = acting.arm_a;
    recalled.row.r_b = acting.arm_b;
    if (rowVelocity(recalled.row, momentum_).x() > pair.collision_speed_mps) continue;
    sources_.insert(sources_.begin() + static_cast<std::ptrdiff_t>(end++), recalled);
  }
}

bool ContactCluster::meetsCarried() const {
  return std::any_of(members_.begin(), members_.end(), [this](const Member& m) {
    const Body& body = bodies_[at(m.body)];
    return body.yields() && body.travel != Travel::kBallistic;
  });
}

void ContactCluster::support() {
  stage_ = Stage::kSupport;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    findEnd(i);
    solve_before_[i] = planned_ends_[i];
  }
  if (isExhausted()) {
    keepPlannedForces();
    return;
  }
  sources_.insert(sources_.begin(), collided_.begin(), collided_.end());
  collided_.clear();
  for (const int pair : event_pairs_) recallPoints(pair);
  rows_.clear();
  for (const SourcedRow& sourced : sources_) {
    rows_.push_back(sourced.row);
    prepareRow(rows_.back(), ends_);
  }
  for (std::size_t first = 0, end = 0; first < sources_.size(); first = end) {
    while (end < sources_.size() && sources_[end].pair == sources_[first].pair) ++end;
    takeOverForces(first, end - first);
  }
  for (std::size_t i = 0, known = members_.size(); i < known; ++i) {
    if (!bodies_[at(members_[i].body)].yields()) continue;
    if (members_[i].expanded) {
      releaseDistant(members_[i].body);
    } else if (members_[i].struck) {
      members_[i].expanded = true;
      expand(members_[i].body);
    }
  }
  solveSpreading(tolerance::kSolverResidual * settings_.gravity.norm() * settings_.step_s);
  takeBackGain(rows_, ends_);
  stops_short_ = isCrowd();
  keepForces();
  findBends();
}

// Forces act on as they did before the event: where no more bodies may join, what ended on one side of a body
// would leave what balanced it on the other to act alone.
void ContactCluster::keepPlannedForces() {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!bodies_[at(members_[i].body)].yields()) continue;
    const std::span<const int> pairs = table_.pairsOf(members_[i].body);
    const bool is_pressed =
        std::any_of(pairs.begin(), pairs.end(), [&](int pair) { return table_.pairs()[at(pair)].presses(); });
    pressed_[i] = is_pressed ? 1 : 0;
  }
  findBends();
}

void ContactCluster::findBends() {
  std::vector<Vec3> accelerations;
  for (std::size_t i = 0; i < members_.size(); ++i)
    accelerations.push_back((ends_[i].velocity.linear - momentum_[i].velocity.linear) / restOfStep());
  bends_.assign(members_.size(), 1);
  for (const SourcedRow& sourced : sources_)
    straightenDips(sourced.row, sourced.gap_m, table_.pairs()[at(sourced.pair)].window, restOfStep(),
                   accelerations, bends_);
}

// What the rows' forces are from now on.
void ContactCluster::keepForces() {
  std::vector<RememberedImpulse> known;
  for (std::size_t first = 0, end = 0; first < sources_.size(); first = end) {
    ShapePair& pair = table_.pairs()[at(sources_[first].pair)];
    known.swap(pair.remembered);
    pair.remembered.clear();
    for (; end < sources_.size() && sources_[end].pair == sources_[first].pair; ++end) {
      const ContactRow& row = rows_[end];
      RememberedImpulse now{.id = sources_[end].id,
                            .force_W = rowImpulse(row, row.impulse) / restOfStep(),
                            .arm_a = row.r_a,
                            .arm_b = row.r_b,
                            .torque_W = rowImpulse(row, row.torque) / restOfStep()};
      for (const RememberedImpulse& before : known)
        if (before.id == now.id) {
          now.impulse_W = before.impulse_W;
          now.torque_impulse_W = before.torque_impulse_W;
        }
      pair.remembered.push_back(now);
      if (row.impulse.x() > 0.0) pressed_[at(row.a)] = pressed_[at(row.b)] = 1;
    }
    counters_.work_J += workOfForces(pair, bodies_, time_s_, settings_.step_s);
  }
}

void ContactCluster::boundPaths(bool all) {
  stage_ = Stage::kPath;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    solve_before_[i] = paths_[i].velocity;
    if (keepsPath(i)) fixPath(i);
  }
  std::erase_if(sources_, [&](const SourcedRow& s) {
    return (!givesWay(s.row.a) && !givesWay(s.row.b)) || (!all && collidesLater(s.row, s));
  });
  rows_.clear();
  for (const SourcedRow& sourced : sources_) {
    rows_.push_back(sourced.row);
    rows_.back().lowest_speed = lowestSpeed(sourced);
    prepareRow(rows_.back(), paths_);
  }
  bool near = solvePaths();
  for (int round = 0; near && round < kTurningRounds && raiseForTurning(all); ++round) near = solvePaths();
}

bool ContactCluster::raiseForTurning(bool all) {
  const PathBounds bounds{bodies_, shapes_, time_s_, restOfStep(), all};
  bool raised = false;
  for (std::size_t first = 0, end = 0; first < sources_.size(); first = end) {
    while (end < sources_.size() && sources_[end].pair == sources_[first].pair) ++end;
    const ShapePair& pair = table_.pairs()[at(sources_[first].pair)];
    raised |=
        carom::raiseForTurning(bounds, pair, paths_, std::span(rows_).subspan(first, end - first), counters_);
  }
  return raised;
}

}  // namespace carom
