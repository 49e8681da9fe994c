#include "engine/simulation/events/contact_cluster.h"

#include <algorithm>

#include "engine/foundation/index.h"
#include "engine/response/collision.h"
#include "engine/response/conjugate_sweeps.h"
#include "engine/response/standing_solver.h"
#include "engine/response/sweeps/energy_bound.h"
#include "engine/response/sweeps/no_room.h"
#include "engine/response/sweeps/principal_pivoting.h"
#include "engine/simulation/contacts/internal_edges.h"
#include "engine/simulation/bodies/path_change.h"

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
    if (stage_ == Stage::kMomentum) endResistance(rows_.back());
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
  for (const int body : {contact.pair.body_a, contact.pair.body_b}) {
    if (!bodies_[at(body)].yields()) continue;
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
  const auto isCareful = [&] { return visits < kCarefulVisits && canBeCareful(); };
  for (int sweeps = 0; isCareful() || sweeps < mostSweeps() || unseen;) {
    const double enough = isCareful() ? std::min(careful_mps, safe) : safe;
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
    const bool leaves_much = report.residual_mps > (canBeCareful() ? kFewRowsShare : 1.0) * safe;
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

std::vector<double> ContactCluster::findRestitution() {
  std::vector<double> restitution(rows_.size(), 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ShapePair& pair = table_.pairs()[at(sources_[i].pair)];
    if (rowVelocity(rows_[i], momentum_).x() >= -pair.collision_speed_mps) continue;
    restitution[i] = pair.restitution;
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
  carom::collide(rows_, momentum_, restitution, canBeCareful() ? 0.0 : safeResidual());
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

bool ContactCluster::meetsCarried() const {
  return std::any_of(members_.begin(), members_.end(), [this](const Member& m) {
    const Body& body = bodies_[at(m.body)];
    return body.yields() && body.travel != Travel::kBallistic;
  });
}

}  // namespace carom
