#include "engine/response/newton_rows.h"

#include <algorithm>
#include <cmath>

#include "engine/foundation/index.h"

namespace carom {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void swapRows(RowMajorMatrix& system, Eigen::VectorXd& solution, Eigen::Index i, Eigen::Index k) {
  if (i == k) return;
  system.row(i).swap(system.row(k));
  std::swap(solution[i], solution[k]);
}

Eigen::Index pivotBelow(const RowMajorMatrix& system, Eigen::Index k) {
  Eigen::Index pivot = k;
  for (Eigen::Index i = k + 1; i < system.rows(); ++i)
    if (std::abs(system(i, k)) > std::abs(system(pivot, k))) pivot = i;
  return pivot;
}

// Gaussian elimination with partial pivoting, in place. Eigen's own cuts its sums by the size of the
// processor's caches: other bits elsewhere.
void eliminate(RowMajorMatrix& system, Eigen::VectorXd& solution) {
  const Eigen::Index size = solution.size();
  for (Eigen::Index k = 0; k < size; ++k) {
    swapRows(system, solution, k, pivotBelow(system, k));
    const double* __restrict pivot = &system(k, 0);
    for (Eigen::Index i = k + 1; i < size; ++i) {
      double* __restrict row = &system(i, 0);
      const double share = row[k] / pivot[k];
      if (share == 0.0) continue;
      for (Eigen::Index j = k + 1; j < size; ++j) row[j] -= share * pivot[j];
      solution[i] -= share * solution[k];
    }
  }
  for (Eigen::Index k = size - 1; k >= 0; --k) {
    for (Eigen::Index j = k + 1; j < size; ++j) solution[k] -= system(k, j) * solution[j];
    solution[k] /= system(k, k);
  }
}

}  // namespace

NewtonRows::NewtonRows(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, bool friction)
    : rows_(rows), bodies_(bodies), friction_(friction), laws_(rows.size()) {
  placeRows();
  const auto size = static_cast<Eigen::Index>(6 * moving_.size());
  system_.resize(size, size);
  change_.resize(size);
}

void NewtonRows::placeRows() {
  std::vector<int> places(bodies_.size(), -1);
  const auto placeOf = [&](int i) {
    const ImpulseBody& body = bodies_[at(i)];
    if (body.inverse_mass == 0.0 || places[at(i)] >= 0) return places[at(i)];
    Moving moving;
    const double turning = body.inverse_tensor.trace() / 3.0;
    if (turning > 0.0) moving.length_m = std::sqrt(body.inverse_mass / turning);
    moving.response.setZero();
    moving.response.diagonal().head<3>() = body.inverse_mass * body.free_axes;
    moving.response.bottomRightCorner<3, 3>() = moving.length_m * moving.length_m * body.inverse_tensor;
    places[at(i)] = static_cast<int>(moving_.size());
    moving_.push_back(moving);
    return places[at(i)];
  };
  const auto jacobian = [&](const ContactRow& row, const Vec3& r, int place) {
    const Mat3 to_row = rowFrame(row).transpose();
    RowJacobian j;
    j << to_row, (-1.0 / moving_[at(place)].length_m) * (to_row * crossMatrix(r));
    return j;
  };
  for (const ContactRow& row : rows_) {
    Place place;
    place.a = placeOf(row.a);
    place.b = placeOf(row.b);
    if (place.a >= 0) place.of_a = -jacobian(row, row.r_a, place.a);
    if (place.b >= 0) place.of_b = jacobian(row, row.r_b, place.b);
    places_.push_back(place);
  }
}

NewtonRows::LinearLaw NewtonRows::lawOf(const ContactRow& row, double compliance) const {
  const Vec3 miss = rowMiss(row, bodies_);
  const double response = row.normal_response.x();
  const double pressing = row.impulse.x() - miss.x() / response;
  if (pressing <= 0.0) return {.impulse = -row.impulse};
  const double stiffness = 1.0 / (compliance * response);
  LinearLaw law{-stiffness * miss, stiffness * Mat3::Identity()};
  const double coefficient = friction_ ? row.coefficient : 0.0;
  const double reach = 1.0 / row.largest_slip_response;
  const Vec2 pull = row.impulse.tail<2>() - reach * miss.tail<2>();
  const double limit = coefficient * pressing;
  const double length = pull.norm();
  if (coefficient > 0.0 && length <= limit) return law;
  // It slides: friction is `limit` along the pull, and turns as the pull does.
  law.stiffness.bottomRows<2>().setZero();
  law.impulse.tail<2>() = -row.impulse.tail<2>();
  if (coefficient == 0.0) return law;
  const Vec2 along = pull / length;
  const Vec2 across(-along.y(), along.x());
  const double turning = limit / length;
  const double softness = 1.0 - turning * (1.0 - reach * compliance * response);
  const Vec2 missing = coefficient * row.impulse.x() * along - row.impulse.tail<2>();
  law.impulse.tail<2>() = (dot(missing, along) + coefficient * law.impulse.x()) * along +
                          (dot(missing, across) / softness) * across;
  law.stiffness.block<2, 1>(1, 0) = coefficient * stiffness * along;
  law.stiffness.bottomRightCorner<2, 2>() = (turning * reach / softness) * across * across.transpose();
  return law;
}

void NewtonRows::add(const Place& place, const LinearLaw& law) {
  const auto addTo = [&](int body, const RowJacobian& j) {
    if (body < 0) return;
    const Eigen::Matrix<double, 6, 3> stiffness = j.transpose() * law.stiffness;
    change_.segment<6>(6 * body) += j.transpose() * law.impulse;
    if (place.a >= 0) system_.block<6, 6>(6 * body, 6 * place.a) += stiffness * place.of_a;
    if (place.b >= 0) system_.block<6, 6>(6 * body, 6 * place.b) += stiffness * place.of_b;
  };
  addTo(place.a, place.of_a);
  addTo(place.b, place.of_b);
}

bool NewtonRows::step(double compliance) {
  system_.setZero();
  change_.setZero();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    laws_[i] = lawOf(rows_[i], compliance);
    add(places_[i], laws_[i]);
  }
  for (std::size_t body = 0; body < moving_.size(); ++body) {
    const auto first = static_cast<Eigen::Index>(6 * body);
    system_.middleRows<6>(first) = (moving_[body].response * system_.middleRows<6>(first)).eval();
    change_.segment<6>(first) = (moving_[body].response * change_.segment<6>(first)).eval();
  }
  system_.diagonal().array() += 1.0;
  eliminate(system_, change_);
  if (!change_.allFinite()) return false;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Place& place = places_[i];
    Vec3 velocity = Vec3::Zero();
    if (place.a >= 0) velocity += place.of_a * change_.segment<6>(6 * place.a);
    if (place.b >= 0) velocity += place.of_b * change_.segment<6>(6 * place.b);
    const Vec3 impulse = laws_[i].impulse - laws_[i].stiffness * velocity;
    rows_[i].impulse += impulse;
    applyToRow(rows_[i], impulse, bodies_);
  }
  return true;
}

double NewtonRows::miss() const {
  double most = 0.0;
  for (const ContactRow& row : rows_) {
    const Vec3 miss = rowMiss(row, bodies_);
    const double pressing = std::max(0.0, row.impulse.x() - miss.x() / row.normal_response.x());
    most = std::max(most, std::abs(pressing - row.impulse.x()) * row.normal_response.x());
    const Vec2 pull = row.impulse.tail<2>() - miss.tail<2>() / row.largest_slip_response;
    const Vec2 friction = shortened(pull, friction_ ? row.coefficient * pressing : 0.0);
    most = std::max(most, (friction - row.impulse.tail<2>()).norm() * row.largest_slip_response);
  }
  return most;
}

}  // namespace carom
