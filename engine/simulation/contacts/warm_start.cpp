#include "engine/simulation/contacts/warm_start.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>

#include "engine/foundation/contract.h"
#include "engine/foundation/index.h"

namespace carom {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

class Memory {
 public:
  explicit Memory(const ShapePair& pair) : pair_(pair) {}

  int named(std::uint64_t id) const {
    for (int i = 0; i < count(); ++i)
      if (pair_.remembered[at(i)].id == id) return i;
    return -1;
  }
  int nearestTo(const Vec3& arm_b) const {
    int nearest = -1;
    double distance = kSamePlace * pair_.window.rest;
    for (int i = 0; i < count(); ++i) {
      const double d = (pair_.remembered[at(i)].arm_b - arm_b).norm();
      if (taken_[at(i)] || d >= distance) continue;
      nearest = i;
      distance = d;
    }
    return nearest;
  }
  const RememberedImpulse& take(int i) {
    taken_[at(i)] = true;
    return pair_.remembered[at(i)];
  }
  /// Impulse and moment on B of what no row has taken.
  Vec6 rest() const {
    Vec6 wrench = Vec6::Zero();
    for (int i = 0; i < count(); ++i) {
      const RememberedImpulse& remembered = pair_.remembered[at(i)];
      if (taken_[at(i)]) continue;
      wrench.head<3>() += remembered.impulse_W;
      wrench.tail<3>() += remembered.arm_b.cross(remembered.impulse_W);
    }
    return wrench;
  }

 private:
  int count() const { return static_cast<int>(pair_.remembered.size()); }

  const ShapePair& pair_;
  std::array<bool, ContactManifold::kMaxPoints> taken_{};
};

// The least impulses at the rows' points that have this impulse and moment together: a + b x r.
void spread(const Vec6& wrench, std::span<const SourcedRow> rows, std::span<Vec3> impulses_W) {
  Mat6 response = Mat6::Zero();
  for (const SourcedRow& sourced : rows) {
    const Mat3 cross = crossMatrix(sourced.row.r_b);
    response.topLeftCorner<3, 3>() += Mat3::Identity();
    response.topRightCorner<3, 3>() -= cross;
    response.bottomLeftCorner<3, 3>() += cross;
    response.bottomRightCorner<3, 3>() -= cross * cross;
  }
  const Vec6 least = response.completeOrthogonalDecomposition().solve(wrench);
  for (std::size_t i = 0; i < rows.size(); ++i)
    impulses_W[i] += least.head<3>() + least.tail<3>().cross(rows[i].row.r_b);
}

}  // namespace

void warmStart(const ShapePair& pair, bool still, std::span<SourcedRow> rows) {
  REQUIRE(rows.size() <= ContactManifold::kMaxPoints, rows.size());
  if (rows.empty() || pair.remembered.empty()) return;
  Memory memory(pair);
  std::array<const RememberedImpulse*, ContactManifold::kMaxPoints> known{};
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const int found = memory.named(rows[i].id); found >= 0) known[i] = &memory.take(found);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (known[i] != nullptr) continue;
    if (const int found = memory.nearestTo(rows[i].row.r_b); found >= 0) known[i] = &memory.take(found);
  }
  std::array<Vec3, ContactManifold::kMaxPoints> impulses_W;
  for (std::size_t i = 0; i < rows.size(); ++i)
    impulses_W[i] = known[i] != nullptr ? known[i]->impulse_W : Vec3(Vec3::Zero());
  const Vec6 rest = memory.rest();
  if (still && !rest.isZero(0.0)) spread(rest, rows, std::span(impulses_W).first(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ContactRow& row = rows[i].row;
    row.impulse = inRowFrame(row, impulses_W[i]);
    row.impulse.x() = std::max(0.0, row.impulse.x());
    if (known[i] != nullptr) row.torque = inRowFrame(row, known[i]->torque_impulse_W);
  }
}

}  // namespace carom
