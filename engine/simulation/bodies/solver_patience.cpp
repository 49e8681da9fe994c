#include "engine/simulation/bodies/solver_patience.h"

#include <algorithm>

#include "engine/foundation/index.h"
#include "engine/foundation/tolerances.h"
#include "engine/response/focused_solver.h"

namespace carom {

SolverPatience::SolverPatience(std::span<const ContactRow> rows, std::vector<Body>& bodies)
    : bodies_(bodies) {
  if (rows.size() < kFocusedRows) return;
  rows_ = rows;
  for (const ContactRow& row : rows_)
    for (const int i : {row.a, row.b}) {
      in_vain_ = std::max(in_vain_, bodies_[at(i)].in_vain);
      swept_alone_ = std::max(swept_alone_, bodies_[at(i)].swept_alone);
    }
}

void SolverPatience::learn(const SolverReport& report, double enough_mps) {
  if (report.products == 0) return;
  if (report.residual_mps <= enough_mps)
    keep(std::max(0, in_vain_ - 1), 0);
  else if (in_vain_ + 1 < tolerance::kSolverPatience)
    keep(in_vain_ + 1, 0);
  else
    keep(in_vain_, tolerance::kSolverPause);
}

void SolverPatience::keep(int in_vain, int swept_alone) {
  for (const ContactRow& row : rows_)
    for (const int i : {row.a, row.b}) {
      if (!bodies_[at(i)].moves()) continue;
      bodies_[at(i)].in_vain = in_vain;
      bodies_[at(i)].swept_alone = swept_alone;
    }
}

}  // namespace carom
