#include "engine/response/conjugate_sweeps.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace carom {
namespace {

constexpr std::size_t kBlock = 2048;  // rows, or bodies, that are summed up, or worked on, together

std::size_t blocksOf(std::size_t count) {
  return (count + kBlock - 1) / kBlock;
}

}  // namespace

std::vector<std::size_t> involvedBodies(std::span<const ContactRow> rows, std::span<ImpulseBody> bodies) {
  std::vector<std::size_t> involved;
  for (const ContactRow& row : rows)
    for (const int i : {row.a, row.b})
      if (!std::exchange(bodies[static_cast<std::size_t>(i)].is_listed, true))
        involved.push_back(static_cast<std::size_t>(i));
  for (const std::size_t i : involved) bodies[i].is_listed = false;
  return involved;
}

ConjugateSweeps::ConjugateSweeps(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, Crew* crew)
    : rows_(rows),
      bodies_(bodies),
      crew_(crew),
      involved_(involvedBodies(rows, bodies)),
      sweeps_(rows, bodies, crew) {
  turning_ = std::any_of(rows.begin(), rows.end(), [](const ContactRow& row) { return row.resists_turning; });
}

// Calls work(block, begin, end) for blocks of the things from 0 to `count`, side by side. The blocks are the
// same for every crew.
template <typename Work>
void ConjugateSweeps::inBlocks(std::size_t count, const Work& work) {
  const std::size_t blocks = blocksOf(count);
  const auto workBlock = [&](int k) {
    const auto block = static_cast<std::size_t>(k);
    work(block, block * kBlock, std::min(count, (block + 1) * kBlock));
  };
  if (crew_ != nullptr && blocks > 1)
    crew_->run(static_cast<int>(blocks), workBlock);
  else
    for (std::size_t block = 0; block < blocks; ++block) workBlock(static_cast<int>(block));
}

// The search begins here, without a direction.
void ConjugateSweeps::begin(bool friction) {
  const std::size_t turning_rows = friction && turning_ ? rows_.size() : 0;
  direction_.impulses.assign(rows_.size(), Vec3::Zero());
  direction_.torques.assign(turning_rows, Vec3::Zero());
  direction_.velocities.assign(involved_.size(), {});
  before_.impulses.resize(rows_.size());
  before_.torques.resize(turning_rows);
  before_.velocities.resize(involved_.size());
  inBlocks(rows_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) before_.impulses[i] = rows_[i].impulse;
  });
  for (std::size_t i = 0; i < turning_rows; ++i) before_.torques[i] = rows_[i].torque;
  inBlocks(involved_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) before_.velocities[k] = bodies_[involved_[k]].velocity;
  });
}

// The squared length of the step that sweeps took, in the measure of energy.
double ConjugateSweeps::squaredStep() {
  squares_.assign(blocksOf(rows_.size()), 0.0);
  const bool turning = !before_.torques.empty();
  inBlocks(rows_.size(), [&](std::size_t block, std::size_t begin, std::size_t end) {
    double squared = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 d = rows_[i].impulse - before_.impulses[i];
      squared += d.x() * d.x() * rows_[i].normal_response.x() +
                 d.tail<2>().squaredNorm() * rows_[i].largest_slip_response;
    }
    for (std::size_t i = begin; turning && i < end; ++i)
      squared += (rows_[i].torque - before_.torques[i]).squaredNorm() * rows_[i].largest_turn_response;
    squares_[block] = squared;
  });
  return std::accumulate(squares_.begin(), squares_.end(), 0.0);
}

// direction = step + share * direction; the part of the old direction is taken as well, and the next step
// begins.
void ConjugateSweeps::continueAlong(double share) {
  const bool turning = !before_.torques.empty();
  inBlocks(rows_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 kept = share * direction_.impulses[i];
      direction_.impulses[i] = rows_[i].impulse - before_.impulses[i] + kept;
      before_.impulses[i] = rows_[i].impulse += kept;
    }
    for (std::size_t i = begin; turning && i < end; ++i) {
      const Vec3 kept = share * direction_.torques[i];
      direction_.torques[i] = rows_[i].torque - before_.torques[i] + kept;
      before_.torques[i] = rows_[i].torque += kept;
    }
  });
  inBlocks(involved_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Velocity& d = direction_.velocities[k];
      Velocity& v = bodies_[involved_[k]].velocity;
      const Velocity kept{share * d.linear, share * d.angular};
      d.linear = v.linear - before_.velocities[k].linear + kept.linear;
      d.angular = v.angular - before_.velocities[k].angular + kept.angular;
      before_.velocities[k].linear = v.linear += kept.linear;
      before_.velocities[k].angular = v.angular += kept.angular;
    }
  });
}

SolverReport ConjugateSweeps::solve(const SolverSettings& settings) {
  SolverReport report;
  begin(settings.friction);
  double last_squared = 0.0;
  while (report.sweeps < settings.sweeps) {
    const bool careful = report.sweeps + 2 < settings.careful_sweeps;
    const double enough = careful ? settings.residual_mps : settings.coarse_residual_mps;
    for (const bool forward : {true, false}) sweeps_.sweep({settings.friction, forward, kVisitAll}, report);
    // The last sweep always ends within the cones: no step along the direction follows it.
    if (report.residual_mps <= enough || report.sweeps >= settings.sweeps) break;
    const double squared = squaredStep();
    const bool shrinks = squared < last_squared;  // else the direction has lost its worth
    continueAlong(shrinks ? squared / last_squared : 0.0);
    last_squared = squared;
  }
  return report;
}

SolverReport solveContactsFinely(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                                 const SolverSettings& settings) {
  return ConjugateSweeps(rows, bodies, settings.crew).solve(settings);
}

}  // namespace carom
