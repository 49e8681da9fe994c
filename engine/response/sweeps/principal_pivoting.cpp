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

}  // namespace carom
