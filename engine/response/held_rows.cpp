#include "engine/response/held_rows.h"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <algorithm>

#include "engine/foundation/index.h"

namespace carom {
namespace {

constexpr double kInsideCone = 1.0 - 1e-9;  // of the limit of friction: more slides

// The row's velocity of a point at arm r per velocity of its body.
Eigen::Matrix<double, 3, 6> jacobian(const ContactRow& row, const Vec3& r) {
  const Mat3 to_row = rowFrame(row).transpose();
  Eigen::Matrix<double, 3, 6> j;
  j << to_row, -to_row * crossMatrix(r);
  return j;
}

bool isHeld(const ContactRow& row) {
  return row.impulse.x() > 0.0 && row.lowest_speed >= 0.0;
}

// What of a held row is an equation: if it slides, its normal part.
Mat3 stiffnessOf(const ContactRow& row) {
  const bool slides = row.impulse.tail<2>().norm() >= kInsideCone * row.coefficient * row.impulse.x();
  if (!slides) return HeldRows::kStiffness * row.inverse_response;
  Mat3 stiffness = Mat3::Zero();
  stiffness(0, 0) = HeldRows::kStiffness / row.normal_response.x();
  return stiffness;
}

struct Equation {
  std::size_t row = 0;
  Mat3 stiffness;
  Vec3 miss;
};

// The order of elimination that keeps the factor sparse, found among bodies rather than their coordinates.
std::vector<int> eliminationOrder(int bodies, const std::vector<std::pair<int, int>>& neighbours) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(at(bodies) + 2 * neighbours.size());
  for (int i = 0; i < bodies; ++i) entries.emplace_back(i, i, 1.0);
  for (const auto& [i, j] : neighbours) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  Eigen::SparseMatrix<double> graph(bodies, bodies);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(graph, order);
  return {order.indices().data(), order.indices().data() + bodies};
}

// Of a body that is so heavy along its locked axes that what an iteration lets it move there is below the
// rounding of the rest.
Mat6 lockedInertia(const ImpulseBody& body) {
  constexpr double kHeavy = 0x1p40;
  const double mass = 1.0 / body.inverse_mass;
  Mat6 inertia = Mat6::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) inertia(i, i) = body.free_axes[i] > 0.0 ? mass : kHeavy * mass;
  // The tensor is 1/J about one axis, or nothing: about that axis J, about the others heavy.
  const double answer = body.inverse_tensor.trace();
  if (!(answer > 0.0)) {
    inertia.bottomRightCorner<3, 3>() = kHeavy * mass * Mat3::Identity();  // as if its radius were a metre
    return inertia;
  }
  constexpr double kOneAxisRounding = 1e-12;
  const Mat3 about_axis = body.inverse_tensor / answer;
  const bool one_axis = (about_axis * about_axis - about_axis).norm() <= kOneAxisRounding;
  inertia.bottomRightCorner<3, 3>() =
      one_axis ? Mat3((about_axis + kHeavy * (Mat3::Identity() - about_axis)) / answer)
               : Mat3(body.inverse_tensor.inverse());
  return inertia;
}

}  // namespace

HeldRows::HeldRows(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies) {
  placeBodies(rows, bodies);
  placeBlocks(rows);
  factor_.emplace(static_cast<int>(inertia_.size()), blocks_);
}

void HeldRows::placeBodies(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies) {
  slots_.assign(bodies.size(), -1);
  std::vector<int> found;
  for (const ContactRow& row : rows) {
    for (const int body : {row.a, row.b}) {
      if (slots_[at(body)] >= 0 || bodies[at(body)].inverse_mass == 0.0) continue;
      slots_[at(body)] = static_cast<int>(found.size());
      found.push_back(body);
    }
  }
  std::vector<std::pair<int, int>> neighbours;
  for (const ContactRow& row : rows)
    if (slots_[at(row.a)] >= 0 && slots_[at(row.b)] >= 0)
      neighbours.emplace_back(slots_[at(row.a)], slots_[at(row.b)]);
  const std::vector<int> order = eliminationOrder(static_cast<int>(found.size()), neighbours);
  for (std::size_t slot = 0; slot < order.size(); ++slot) {
    const int body = found[at(order[slot])];
    slots_[at(body)] = static_cast<int>(slot);
    Mat6 inertia = Mat6::Zero();
    if (bodies[at(body)].has_locks) {
      inertia = lockedInertia(bodies[at(body)]);
    } else {
      inertia.topLeftCorner<3, 3>().diagonal().setConstant(1.0 / bodies[at(body)].inverse_mass);
      inertia.bottomRightCorner<3, 3>() = bodies[at(body)].inverse_tensor.inverse();
    }
    inertia_.push_back(inertia);
  }
}

void HeldRows::placeBlocks(std::span<const ContactRow> rows) {
  std::vector<std::pair<int, int>> pairs;  // (column, row)
  for (const ContactRow& row : rows) {
    places_.push_back(
        {-jacobian(row, row.r_a), jacobian(row, row.r_b), slots_[at(row.a)], slots_[at(row.b)]});
    const RowPlace& place = places_.back();
    if (place.slot_a >= 0 && place.slot_b >= 0) pairs.push_back(std::minmax(place.slot_a, place.slot_b));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [column, row] : pairs) blocks_.push_back({row, column, Mat6::Zero()});
  for (RowPlace& place : places_) {
    if (place.slot_a < 0 || place.slot_b < 0) continue;
    const std::pair<int, int> pair = std::minmax(place.slot_a, place.slot_b);
    place.block = static_cast<int>(std::lower_bound(pairs.begin(), pairs.end(), pair) - pairs.begin());
  }
}

void HeldRows::addRow(const RowPlace& place, const Mat3& stiffness, const Vec3& miss) {
  const RowJacobian on_a = stiffness * place.of_a;
  const RowJacobian on_b = stiffness * place.of_b;
  const Vec3 force = stiffness * miss;
  if (place.slot_a >= 0) {
    diagonal_[at(place.slot_a)] += place.of_a.transpose() * on_a;
    push_.segment<6>(6 * place.slot_a) -= place.of_a.transpose() * force;
  }
  if (place.slot_b >= 0) {
    diagonal_[at(place.slot_b)] += place.of_b.transpose() * on_b;
    push_.segment<6>(6 * place.slot_b) -= place.of_b.transpose() * force;
  }
  if (place.block < 0) return;
  if (place.slot_a > place.slot_b)
    blocks_[at(place.block)].value += place.of_a.transpose() * on_b;
  else
    blocks_[at(place.block)].value += place.of_b.transpose() * on_a;
}

bool HeldRows::step(std::span<ContactRow> rows, std::span<ImpulseBody> bodies) {
  diagonal_ = inertia_;
  for (OffDiagonalBlock& block : blocks_) block.value.setZero();
  push_.setZero(6 * static_cast<int>(inertia_.size()));
  std::vector<Equation> equations;
  equations.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!isHeld(rows[i])) continue;
    equations.push_back({i, stiffnessOf(rows[i]), rowMiss(rows[i], bodies)});
    addRow(places_[i], equations.back().stiffness, equations.back().miss);
  }
  if (!factor_->factorize(diagonal_, blocks_)) return false;
  Eigen::VectorXd& change = push_;
  factor_->solve(change);
  if (!change.allFinite()) return false;
  for (const Equation& equation : equations) {
    const RowPlace& place = places_[equation.row];
    Vec3 miss = equation.miss;
    if (place.slot_a >= 0) miss += place.of_a * change.segment<6>(6 * place.slot_a);
    if (place.slot_b >= 0) miss += place.of_b * change.segment<6>(6 * place.slot_b);
    const Vec3 impulse = -equation.stiffness * miss;
    rows[equation.row].impulse += impulse;
    applyToRow(rows[equation.row], impulse, bodies);
  }
  return true;
}

}  // namespace carom
