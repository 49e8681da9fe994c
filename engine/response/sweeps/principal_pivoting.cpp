#include "engine/response/sweeps/principal_pivoting.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

namespace carom {
namespace {

constexpr Eigen::Index kPivots = 4;  // a row
// All wrong rows change sides at once, as long as they become fewer within so many rounds (Judice and Pires
// 1994); then one by one (Murty 1974), which ends.
constexpr int kBlocksInVain = 3;
constexpr double kRegular = 1e-13;  // of a row's own response: so much, one that repeats another gives way

}  // namespace

std::optional<Eigen::VectorXd> pivotImpulses(const Eigen::MatrixXd& response, const Eigen::VectorXd& missing,
                                             const Eigen::VectorXd& slack) {
  const Eigen::Index size = missing.size();
  Eigen::MatrixXd regular = response;
  regular.diagonal() *= 1.0 + kRegular;
  std::vector<bool> presses(static_cast<std::size_t>(size), false);
  Eigen::VectorXd impulses = Eigen::VectorXd::Zero(size);
  std::size_t fewest = static_cast<std::size_t>(size) + 1;  // wrong rows, so far
  int in_vain = 0;
  for (Eigen::Index pivot = 0; pivot <= kPivots * size; ++pivot) {
    const Eigen::VectorXd short_of = missing - regular * impulses;
    std::vector<Eigen::Index> wrong;  // they pull, or are short and do not press
    for (Eigen::Index i = 0; i < size; ++i)
      if (presses[static_cast<std::size_t>(i)] ? impulses[i] < 0.0 : short_of[i] > slack[i])
        wrong.push_back(i);
    if (wrong.empty()) {
      // Rows that contradict each other balance by what gives way alone, with impulses without measure.
      const bool holds = ((missing - response * impulses).array() <= slack.array()).all();
      return holds ? std::optional(impulses) : std::nullopt;
    }
    in_vain = wrong.size() < fewest ? 0 : in_vain + 1;
    fewest = std::min(fewest, wrong.size());
    if (in_vain > kBlocksInVain) wrong.erase(wrong.begin() + 1, wrong.end());
    for (const Eigen::Index i : wrong) presses[static_cast<std::size_t>(i)].flip();
    std::vector<Eigen::Index> pressing;
    for (Eigen::Index i = 0; i < size; ++i)
      if (presses[static_cast<std::size_t>(i)]) pressing.push_back(i);
    const Eigen::MatrixXd of_pressing = regular(pressing, pressing);
    const Eigen::VectorXd wanted = missing(pressing);
    const Eigen::VectorXd solved = of_pressing.ldlt().solve(wanted);
    impulses.setZero();
    impulses(pressing) = solved;
  }
  return std::nullopt;
}

bool pivotRows(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, const Eigen::VectorXd& slack_mps,
               std::size_t most_rows) {
  if (rows.size() > most_rows) return false;
  const auto size = static_cast<Eigen::Index>(rows.size());
  const auto rowAt = [&](Eigen::Index i) -> ContactRow& { return rows[static_cast<std::size_t>(i)]; };
  Eigen::VectorXd missing(size);
  for (Eigen::Index i = 0; i < size; ++i) missing[i] = -rowMiss(rowAt(i), bodies).x();
  std::vector<ImpulseBody> moved(bodies.begin(), bodies.end());
  Eigen::MatrixXd response(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (ImpulseBody& body : moved) body.velocity = {};
    applyToRow(rowAt(i), Vec3::UnitX(), moved);
    for (Eigen::Index k = 0; k < size; ++k) response(k, i) = rowVelocity(rowAt(k), moved).x();
  }
  const std::optional<Eigen::VectorXd> impulses = pivotImpulses(response, missing, slack_mps);
  if (!impulses) return false;
  for (Eigen::Index i = 0; i < size; ++i) {
    rowAt(i).impulse = {(*impulses)[i], 0.0, 0.0};
    applyToRow(rowAt(i), rowAt(i).impulse, bodies);
  }
  return true;
}

}  // namespace carom
