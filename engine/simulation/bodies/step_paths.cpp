#include "engine/simulation/bodies/step_paths.h"

#include <algorithm>

namespace carom {

void StepPaths::beginStep(std::size_t bodies, int substeps, double substep_s) {
  pieces_.resize(bodies);
  for (const std::size_t index : told_of_) pieces_[index].clear();
  told_of_.clear();
  substeps_ = substeps;
  substep_s_ = substep_s;
}

void StepPaths::add(std::size_t index, const StepMotion& motion, double time_s) {
  if (pieces_[index].empty()) told_of_.push_back(index);
  pieces_[index].push_back({substep_, time_s, motion});
}

BodyState StepPaths::stateAt(std::size_t index, const Inertia& inertia, double share,
                             const BodyState& at_end) const {
  // The end of the step is the end of its last substep, to the bit.
  const int substep = std::min(static_cast<int>(share * substeps_), substeps_ - 1);
  const double time_s = (share * substeps_ - substep) * substep_s_;
  const std::vector<Piece>& pieces = pieces_[index];
  const auto piece = std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) {
    return p.substep > substep || (p.substep == substep && time_s <= p.end_s);
  });
  if (piece == pieces.end()) return at_end;
  const StepMotion& motion = piece->motion;
  const double t_s = piece->substep == substep ? time_s : motion.path.start_s;
  const Pose X_WB = motion.path.at(t_s);
  const Velocity velocity = motion.velocityAt(inertia, t_s, X_WB.rotation);
  return {X_WB, velocity.linear, velocity.angular, at_end.mode};
}

}  // namespace carom
