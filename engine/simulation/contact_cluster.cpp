#include "engine/simulation/contact_cluster.h"

#include <algorithm>
#include <cmath>

#include "engine/response/collision.h"

namespace carom {
namespace {

constexpr int kSweepsARound = 4;  // between two looks at whom the impulses have reached
constexpr int kMostSweeps = 80;   // of one solve
// Small clusters are solved to this share of the approach; when so many rows have been visited, and for
// paths, it is enough that what is left over cannot use up much of the gap within a step.
constexpr double kShareOfApproach = 1e-10;
constexpr long kCarefulVisits = 1000;
constexpr double kGapShare = 0.4;  // of the rest gap
// Approaches of one instant that differ by a smaller share are one collision: what is symmetric stays so.
constexpr double kSameApproach = 1e-6;
constexpr double kSlowShare = 0.5;  // of the collision speed: the fastest closing left to a gap in the window

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void ContactCluster::begin(int pair, const ClosestFeatures& closest, double time_s) {
  ++number_;
  body_joined_.resize(bodies_.size(), 0);
  body_member_.resize(bodies_.size(), 0);
  pair_joined_.resize(table_.pairs().size(), 0);
  time_s_ = time_s;
  event_pair_ = pair;
  stage_ = Stage::kMomentum;
  members_.clear();
  momentum_.clear();
  paths_.clear();
  solve_before_.clear();
  sources_.clear();
  rows_.clear();
  addPair(pair, closest);
}

int ContactCluster::join(int index) {
  if (body_joined_[at(index)] == number_) return body_member_[at(index)];
  body_joined_[at(index)] = number_;
  body_member_[at(index)] = static_cast<int>(members_.size());
  const Body& body = bodies_[at(index)];
  Member member;
  member.body = index;
  member.expanded = body.is_static;
  if (!body.is_static) {
    member.momentum_before = body.velocityAt(time_s_);
    member.path_before = {body.path.velocityAt(time_s_), body.path.angularVelocityAt(time_s_)};
  }
  members_.push_back(member);
  momentum_.push_back(body.impulseBody(body.path.at(time_s_), member.momentum_before));
  paths_.push_back(momentum_.back());
  paths_.back().velocity = member.path_before;
  if (body.travel == Travel::kHeld) {  // momentum may change, the path may not
    paths_.back().inverse_mass = 0.0;
    paths_.back().inverse_tensor.setZero();
  }
  solve_before_.push_back(stageBodies().back().velocity);
  return body_member_[at(index)];
}

double ContactCluster::lowestSpeed(const SourcedRow& sourced) const {
  const ShapePair& pair = table_.pairs()[at(sourced.pair)];
  const GapSpeeds bounds = gapSpeeds(sourced.gap_m, pair.window, settings_.step_s - time_s_);
  if (stage_ == Stage::kPath) return bounds.path;
  if (sourced.pair == event_pair_) return 0.0;
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
  appendRows({index, a, b, &closest, bodies_[at(pair.body_a)].path.at(time_s_),
              bodies_[at(pair.body_b)].path.at(time_s_)},
             pair, bodies_, shapes_, stageBodies(), sources_);
  const double highest =
      std::max(closest.distance_m, index == event_pair_ ? pair.window.ceiling : pair.window.manifold);
  std::erase_if(sources_, [&](const SourcedRow& s) { return s.pair == index && s.gap_m > highest; });
  for (std::size_t i = first; i < sources_.size(); ++i) {
    rows_.push_back(sources_[i].row);
    rows_.back().lowest_speed = lowestSpeed(sources_[i]);
  }
}

void ContactCluster::expand(int body) {
  for (int p : table_.pairsOf(body)) {
    if (pair_joined_[at(p)] == number_) continue;
    pair_joined_[at(p)] = number_;
    ShapePair& pair = table_.pairs()[at(p)];
    const ClosestFeatures closest = closestFeatures(
        *shapes_[at(pair.shapes.a)].part, bodies_[at(pair.body_a)].path.at(time_s_),
        *shapes_[at(pair.shapes.b)].part, bodies_[at(pair.body_b)].path.at(time_s_), pair.tracked);
    ++counters_.distance_queries;
    if (closest.distance_m <= pair.window.manifold) addPair(p, closest);
  }
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
    if (bodies_[at(members_[i].body)].is_static) continue;
    for (int p : table_.pairsOf(members_[i].body)) {
      ShapePair& pair = table_.pairs()[at(p)];
      if (pair_joined_[at(p)] == number_ || !isNear(pair)) continue;
      pair_joined_[at(p)] = number_;
      const Body& a = bodies_[at(pair.body_a)];
      const Body& b = bodies_[at(pair.body_b)];
      const Pose X_WA = a.path.at(time_s_);
      const Pose X_WB = b.path.at(time_s_);
      const ClosestFeatures closest = closestFeatures(*shapes_[at(pair.shapes.a)].part, X_WA,
                                                      *shapes_[at(pair.shapes.b)].part, X_WB, pair.tracked);
      ++counters_.distance_queries;
      const Vec3 relative = b.velocityAt(time_s_).at(closest.p_B_W - X_WB.position) -
                            a.velocityAt(time_s_).at(closest.p_A_W - X_WA.position);
      if (closest.distance_m <= pair.window.ceiling &&
          std::abs(closest.n_W.dot(relative) - approach_mps) <= -kSameApproach * approach_mps)
        addPair(p, closest);
    }
  }
}

double ContactCluster::safeResidual() const {
  return kGapShare * table_.pairs()[at(event_pair_)].window.rest / settings_.step_s;
}

void ContactCluster::solveSpreading(double careful_mps) {
  const bool friction = stage_ == Stage::kMomentum;
  const double safe = safeResidual();
  long visits = 0;
  for (int sweeps = 0; visits < kCarefulVisits || sweeps < kMostSweeps;) {
    const double enough = visits < kCarefulVisits ? std::min(careful_mps, safe) : safe;
    const SolverReport report = solveContacts(
        rows_, stageBodies(),
        {.sweeps = kSweepsARound, .residual_mps = enough, .friction = friction, .resumes = sweeps > 0});
    sweeps += report.sweeps;
    visits += report.visits;
    visits_ += report.visits;
    const bool grew = !isExhausted() && expandMoved(safe);
    if (!grew && report.residual_mps <= enough) return;
  }
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
    return s.pair != event_pair_ && s.gap_m > table_.pairs()[at(s.pair)].window.ceiling;
  });
  rows_.clear();
  for (const SourcedRow& sourced : sources_) rows_.push_back(sourced.row);
}

void ContactCluster::boundPaths() {
  stage_ = Stage::kPath;
  for (std::size_t i = 0; i < members_.size(); ++i) solve_before_[i] = paths_[i].velocity;
  std::erase_if(sources_, [&](const SourcedRow& s) { return !givesWay(s.row.a) && !givesWay(s.row.b); });
  rows_.clear();
  for (const SourcedRow& sourced : sources_) {
    rows_.push_back(sourced.row);
    rows_.back().lowest_speed = lowestSpeed(sourced);
    prepareRow(rows_.back(), paths_);
  }
  solveSpreading(safeResidual());
  const PathBounds bounds{bodies_, shapes_, table_.pairs(), time_s_, settings_.step_s - time_s_};
  for (int round = 0; round < kTurningRounds; ++round) {
    if (!raiseForTurning(bounds, sources_, paths_, rows_, counters_)) break;
    solveSpreading(safeResidual());
  }
}

}  // namespace carom
