#include "engine/response/sweeps/dissection.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "engine/foundation/index.h"

namespace carom {
namespace {

double extent(const DissectionPlan& plan, std::span<const int> members, const Vec3& direction) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const int i : members) {
    const double place = dot(direction, plan.bodies[at(i)].center);
    low = std::min(low, place);
    high = std::max(high, place);
  }
  return high - low;
}

Vec3 longest(const DissectionPlan& plan, std::span<const int> members) {
  return *std::max_element(plan.directions.begin(), plan.directions.end(), [&](const Vec3& d, const Vec3& e) {
    return extent(plan, members, d) < extent(plan, members, e);
  });
}

void divide(const DissectionPlan& plan, std::span<int> members, int levels, int part,
            std::span<int> part_of) {
  if (levels == 0) {
    for (const int i : members) part_of[at(i)] = part;
    return;
  }
  if (members.empty()) return;
  const Vec3 direction = longest(plan, members);
  const auto place = [&](int i) { return std::tuple(dot(direction, plan.bodies[at(i)].center), i); };
  const std::size_t half = members.size() / 2;
  std::nth_element(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(half), members.end(),
                   [&](int i, int j) { return place(i) < place(j); });
  divide(plan, members.first(half), levels - 1, 2 * part, part_of);
  divide(plan, members.subspan(half), levels - 1, 2 * part + 1, part_of);
}

}  // namespace

void dissect(const DissectionPlan& plan, std::span<int> members, std::span<int> part_of) {
  divide(plan, members, plan.levels, kWhole, part_of);
}

}  // namespace carom
