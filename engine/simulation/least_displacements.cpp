// The dual is min 1/2 f.(J P J^T + c) f - opening.f over f >= 0, where row k of J takes displacements to the
// opening of row k, and P takes from them what is along axes that are not free. It is solved by "modified
// proportioning with reduced gradient projections" (Z. Dostal, J. Schoeberl, Minimizing quadratic functions
// subject to bound constraints with the rate of convergence and finite termination, Comput. Optim. Appl. 30,
// 2005): conjugate gradients among the forces that are not zero, a projected step where some of them would
// pull, and a steepest step among those that are zero where these miss most. Every operation treats all rows
// alike, so that a mirror image has the mirror image's displacements to rounding.

#include "engine/foundation/index.h"
#include "engine/simulation/least_displacements.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// The compliance c of a row, metres by which it gives way for a unit of force. A line of N touching bodies
// opens with forces of N^2 / 8 openings, and misses that times c: 0.1 % of an opening at N = 300.
constexpr double kStiff = 1e-7;
// The compliance where there is no room: forces are then what is missing over c, and conjugate gradients find
// them to some digits only if they are not too large.
constexpr double kSoft = 1e-5;
// Of the largest opening: displacements that miss less have been found.
constexpr double kResidual = 1e-12;
// Of the largest opening: where displacements miss more, there is no room.
constexpr double kLacking = 0.1;
// Of what is missing where there is no room: a residual below is near enough.
constexpr double kPart = 1e-9;
// Products with the matrix, at most: a line of N touching bodies takes some 1.5 N. What is not done is
// missing.
constexpr int kProducts = 5000;
// Rows visited in all products, at most.
constexpr int kRowVisits = 30000000;

using Forces = std::vector<double>;

// Against `direction`, to zero at most.
void follow(const Forces& direction, double length, Forces& force) {
  for (std::size_t k = 0; k < force.size(); ++k) force[k] = std::max(0.0, force[k] - length * direction[k]);
}

class Dual {
 public:
  Dual(std::span<const Opening> openings, std::span<const Vec3> free_axes, double compliance)
      : openings_(openings),
        free_axes_(free_axes),
        compliance_(compliance),
        moved_(free_axes.size()),
        force_(openings.size()),
        gradient_(openings.size()) {
    for (std::size_t k = 0; k < openings.size(); ++k) {
      gradient_[k] = -openings[k].opening_m;
      largest_m_ = std::max(largest_m_, openings[k].opening_m);
    }
    step_ = 1.0 / largestEigenvalue();
  }

  void solve();
  bool isSolved() const;
  bool hasRoom() const { return greatestMissing() <= kLacking * largest_m_; }
  const std::vector<Vec3>& displacements() {
    pushBodies(force_);
    return moved_;
  }
  // The gradient is what is done of an opening, with the row's own compliance, less the opening.
  double missing(std::size_t k) const { return compliance_ * force_[k] - gradient_[k]; }
  int products() const { return products_; }

 private:
  double largestEigenvalue() const;
  void pushBodies(const Forces& force);
  void multiply(const Forces& force, Forces& result);
  void findGradient();
  double value() const;
  void splitGradient();
  void stepFreely();
  void stepProportioning();
  double greatestMissing() const;

  std::span<const Opening> openings_;
  std::span<const Vec3> free_axes_;
  double compliance_;
  std::vector<Vec3> moved_;
  Forces force_, gradient_, product_;
  Forces free_;     ///< The gradient where forces are above zero.
  Forces chopped_;  ///< The gradient where they are zero and would grow.
  Forces direction_;
  Forces former_;         ///< Forces before a step.
  double reduced_ = 0.0;  ///< The free gradient times how far it may be followed by one step.
  double largest_m_ = 0.0;
  double step_ = 0.0;
  int products_ = 0;
};

// A bound: J^T J has on its diagonal how many rows a body has, and as much again beside it at most; P makes
// it no larger.
double Dual::largestEigenvalue() const {
  std::vector<int> rows(moved_.size());
  int most = 1;
  for (const Opening& opening : openings_)
    for (const int body : {opening.a, opening.b})
      if (body >= 0) most = std::max(most, ++rows[at(body)]);
  return 2.0 * most + compliance_;
}

void Dual::pushBodies(const Forces& force) {
  std::fill(moved_.begin(), moved_.end(), Vec3(Vec3::Zero()));
  for (std::size_t k = 0; k < openings_.size(); ++k) {
    if (force[k] == 0.0) continue;
    const Vec3 push = force[k] * openings_[k].n_W;
    if (openings_[k].a >= 0) moved_[at(openings_[k].a)] -= push;
    if (openings_[k].b >= 0) moved_[at(openings_[k].b)] += push;
  }
  for (std::size_t i = 0; i < moved_.size(); ++i) moved_[i] = moved_[i].cwiseProduct(free_axes_[i]);
}

void Dual::multiply(const Forces& force, Forces& result) {
  ++products_;
  pushBodies(force);
  result.resize(force.size());
  for (std::size_t k = 0; k < openings_.size(); ++k) {
    const Opening& o = openings_[k];
    Vec3 parted = Vec3::Zero();
    if (o.a >= 0) parted -= moved_[at(o.a)];
    if (o.b >= 0) parted += moved_[at(o.b)];
    result[k] = dot(o.n_W, parted) + compliance_ * force[k];
  }
}

void Dual::findGradient() {
  multiply(force_, gradient_);
  for (std::size_t k = 0; k < force_.size(); ++k) gradient_[k] -= openings_[k].opening_m;
}

double Dual::value() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < force_.size(); ++k)
    sum += 0.5 * force_[k] * (gradient_[k] - openings_[k].opening_m);
  return sum;
}

void Dual::splitGradient() {
  free_.assign(force_.size(), 0.0);
  chopped_.assign(force_.size(), 0.0);
  reduced_ = 0.0;
  for (std::size_t k = 0; k < force_.size(); ++k) {
    if (force_[k] > 0.0) {
      free_[k] = gradient_[k];
      reduced_ += std::min(force_[k] / step_, gradient_[k]) * gradient_[k];
    } else {
      chopped_[k] = std::min(gradient_[k], 0.0);
    }
  }
}

// Conjugate gradients. Where a force would pull, the step is cut off for each force at zero, which frees many
// at once; should that not bring the dual down, the step ends where the first force is zero, and one along
// the gradient follows, short enough that it always does.
void Dual::stepFreely() {
  multiply(direction_, product_);
  const double curvature = dot(direction_, product_);
  const double length = dot(gradient_, direction_) / curvature;
  double feasible = length;
  for (std::size_t k = 0; k < force_.size(); ++k)
    if (direction_[k] > 0.0) feasible = std::min(feasible, force_[k] / direction_[k]);
  if (feasible == length) {
    follow(direction_, length, force_);
    for (std::size_t k = 0; k < force_.size(); ++k) gradient_[k] -= length * product_[k];
    splitGradient();
    const double kept = dot(free_, product_) / curvature;
    for (std::size_t k = 0; k < force_.size(); ++k) direction_[k] = free_[k] - kept * direction_[k];
    return;
  }
  const double before = value();
  former_ = force_;
  follow(direction_, length, force_);
  findGradient();
  if (!(value() < before)) {
    force_ = former_;
    follow(direction_, feasible, force_);
    findGradient();
    splitGradient();
    follow(free_, step_, force_);
    findGradient();
  }
  splitGradient();
  direction_ = free_;
}

// Along the chopped gradient alone: those forces begin to press.
void Dual::stepProportioning() {
  multiply(chopped_, product_);
  const double length = dot(gradient_, chopped_) / dot(chopped_, product_);
  for (std::size_t k = 0; k < force_.size(); ++k) {
    force_[k] -= length * chopped_[k];
    gradient_[k] -= length * product_[k];
  }
  splitGradient();
  direction_ = free_;
}

double largestOf(const Forces& x) {
  double largest = 0.0;
  for (const double value : x) largest = std::max(largest, std::abs(value));
  return largest;
}

// What its compliance makes of the largest force.
double Dual::greatestMissing() const {
  return compliance_ * largestOf(force_);
}

// Of what is missing where there is no room only some digits are found: what is to be done about it is asked
// again with other openings.
bool Dual::isSolved() const {
  const double residual = std::max(largestOf(free_), largestOf(chopped_));
  return residual <= kResidual * largest_m_ || (!hasRoom() && residual <= kPart * greatestMissing());
}

void Dual::solve() {
  splitGradient();
  direction_ = free_;
  const int most =
      std::min(kProducts, kRowVisits / static_cast<int>(std::max<std::size_t>(1, force_.size())));
  while (products_ < most && !isSolved() && (hasRoom() || compliance_ == kSoft)) {
    if (dot(chopped_, chopped_) <= reduced_)
      stepFreely();
    else
      stepProportioning();
  }
}

}  // namespace

LeastDisplacements leastDisplacements(std::span<const Opening> openings, std::span<const Vec3> free_axes) {
  Dual stiff(openings, free_axes, kStiff);
  stiff.solve();
  Dual soft(openings, free_axes, kSoft);
  const bool done = stiff.isSolved() && stiff.hasRoom();
  if (!done) soft.solve();
  Dual& dual = done ? stiff : soft;
  LeastDisplacements least{dual.displacements(), {}, stiff.products() + soft.products()};
  for (std::size_t k = 0; k < openings.size(); ++k) least.missing_m.push_back(dual.missing(k));
  return least;
}

}  // namespace carom
