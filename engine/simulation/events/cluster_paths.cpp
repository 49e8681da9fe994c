// The paths of what an event reaches, led by its contacts: the last of a cluster's three solves.

#include "engine/foundation/index.h"
#include "engine/response/sweeps/principal_pivoting.h"
#include "engine/simulation/bodies/path_change.h"
#include "engine/simulation/events/contact_cluster.h"

namespace carom {
namespace {

// Of the safe residual: the one to which the paths of small clusters are solved.
constexpr double kPathShare = 0.01;

}  // namespace

// Its momentum may change, its path may not.
void ContactCluster::fixPath(std::size_t i) {
  paths_[i].inverse_mass = 0.0;
  paths_[i].inverse_tensor.setZero();
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
