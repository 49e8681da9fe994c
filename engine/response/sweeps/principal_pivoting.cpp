#include "engine/response/sweeps/principal_pivoting.h"

#include <Eigen/Cholesky>
#include <vector>

namespace carom {
namespace {

constexpr Eigen::Index kPivots = 4;  // a row
constexpr double kRegular = 1e-13;   // of a row's own response: so much, one that repeats another gives way

}  // namespace

std::optional<Eigen::VectorXd> pivotImpulses(const Eigen::MatrixXd& response, const Eigen::VectorXd& missing,
                                             const Eigen::VectorXd& slack) {
  const Eigen::Index size = missing.size();
  Eigen::MatrixXd regular = response;
  regular.diagonal() *= 1.0 + kRegular;
  std::vector<bool> presses(static_cast<std::size_t>(size), false);
  Eigen::VectorXd impulses = Eigen::VectorXd::Zero(size);
  for (Eigen::Index pivot = 0; pivot <= kPivots * size; ++pivot) {
    const Eigen::VectorXd short_of = missing - regular * impulses;
    std::vector<Eigen::Index> pressing;
    Eigen::Index wrong = size;  // the first that pulls, or that is short and does not press
    for (Eigen::Index i = 0; i < size; ++i) {
      const bool presses_i = presses[static_cast<std::size_t>(i)];
      const bool is_wrong = presses_i ? impulses[i] < 0.0 : short_of[i] > slack[i];
      if (is_wrong && wrong == size) wrong = i;
      if (presses_i != (is_wrong && wrong == i)) pressing.push_back(i);
    }
    if (wrong == size) {
      // Rows that contradict each other balance by what gives way alone, with impulses without measure.
      const bool holds = ((missing - response * impulses).array() <= slack.array()).all();
      return holds ? std::optional(impulses) : std::nullopt;
    }
    presses[static_cast<std::size_t>(wrong)].flip();
    const Eigen::MatrixXd of_pressing = regular(pressing, pressing);
    const Eigen::VectorXd wanted = missing(pressing);
    const Eigen::VectorXd solved = of_pressing.ldlt().solve(wanted);
    impulses.setZero();
    impulses(pressing) = solved;
  }
  return std::nullopt;
}

bool pivotRows(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, const Eigen::VectorXd& slack_mps) {
  if (rows.size() > kMostPivotedRows) return false;
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
