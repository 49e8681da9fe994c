#include "demos/overlay/near_pairs.h"

#include <algorithm>
#include <limits>

#include "demos/format/nearest_name.h"
#include "demos/system/exit_code.h"
#include "engine/broad_phase/bounds_tree.h"

namespace carom::demos {
namespace {

constexpr double kNearOverRadius = 0.3;  // Of the smallest body that moves.
constexpr int kDoublings = 24;           // Of that distance, until a pair is found.

struct PlacedPart {
  int body = -1;
  const ConvexPart* part = nullptr;
  double width_m = 0.0;  // of the body, as the collision window takes it
  bool moves = true;
};

Bounds boundsOf(const ConvexPart& part, const Pose& X_WB, double margin) {
  Bounds bounds{Vec3::Constant(std::numeric_limits<double>::infinity()),
                Vec3::Constant(-std::numeric_limits<double>::infinity())};
  for (const Vec3& v : part.core.vertices()) {
    const Vec3 p_W = X_WB * v;
    bounds.low = bounds.low.cwiseMin(p_W);
    bounds.high = bounds.high.cwiseMax(p_W);
  }
  bounds.low.array() -= part.radius_m + margin;
  bounds.high.array() += part.radius_m + margin;
  return bounds;
}

// Parts of different bodies of which one moves, by bounds; ascending.
std::vector<IndexPair> candidatesWithin(double reach, std::span<const PlacedPart> parts,
                                        std::span<const BodyState> states) {
  std::vector<Bounds> bounds;
  for (const PlacedPart& p : parts)
    bounds.push_back(boundsOf(*p.part, states[static_cast<std::size_t>(p.body)].X_WB, 0.5 * reach));
  BoundsTree tree;
  tree.build(bounds);
  std::vector<IndexPair> candidates;
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
    const PlacedPart& part = parts[static_cast<std::size_t>(i)];
    if (!part.moves) continue;
    tree.find(bounds[static_cast<std::size_t>(i)], found);
    for (const int j : found) {
      const PlacedPart& other = parts[static_cast<std::size_t>(j)];
      if (other.body == part.body || (other.moves && j < i)) continue;  // once
      if (candidates.size() >= kMostPairs) throw TooManyPairs();
      candidates.push_back({std::min(i, j), std::max(i, j)});
    }
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

NearPair asked(const PlacedPart& a, const PlacedPart& b, std::span<const BodyState> states) {
  NearPair pair{a.body,
                b.body,
                a.part,
                b.part,
                states[static_cast<std::size_t>(a.body)].X_WB,
                states[static_cast<std::size_t>(b.body)].X_WB,
                {},
                collisionWindow(std::min(a.width_m, b.width_m))};
  FeaturePair cold;
  pair.closest = closestFeatures(*a.part, pair.X_WA, *b.part, pair.X_WB, cold);
  return pair;
}

}  // namespace

BodyFocus::BodyFocus(const std::string& names, const std::vector<std::string>& bodies) {
  if (names.empty()) return;
  chosen_.assign(bodies.size(), false);
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find(',', begin), names.size());
    const std::string name = names.substr(begin, end - begin);
    bool known = false;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i] != name && bodies[i].substr(0, bodies[i].find('[')) != name) continue;
      chosen_[i] = known = true;
    }
    if (!known) throw UsageError("--focus: no body \"" + name + "\"" + acceptedNames(name, bodies));
    ++count_;
    begin = end + 1;
  }
}

bool BodyFocus::hasPair(int a, int b) const {
  return count_ == 1 ? has(a) || has(b) : has(a) && has(b);
}

std::vector<NearPair> nearPairs(const World& world, std::span<const BodyState> states,
                                const BodyFocus& focus) {
  std::vector<PlacedPart> parts;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyDescription& body = world.bodies()[i];
    const Solid& solid = world.solids()[static_cast<std::size_t>(body.solid)];
    if (!body.is_static) smallest = std::min(smallest, solid.radius());
    const double width = body.is_static ? std::numeric_limits<double>::infinity() : solid.width();
    for (const ConvexPart& part : solid.parts())
      parts.push_back({static_cast<int>(i), &part, width, !body.is_static});
  }
  std::vector<NearPair> pairs;
  double reach = kNearOverRadius * smallest;
  for (int i = 0; i < kDoublings && pairs.empty() && smallest < 1e300; ++i, reach *= 2.0) {
    for (const IndexPair& candidate : candidatesWithin(reach, parts, states)) {
      const PlacedPart& a = parts[static_cast<std::size_t>(candidate.a)];
      const PlacedPart& b = parts[static_cast<std::size_t>(candidate.b)];
      if (!focus.hasPair(a.body, b.body)) continue;
      NearPair pair = asked(a, b, states);
      if (pair.closest.distance_m <= reach) pairs.push_back(pair);
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const NearPair& x, const NearPair& y) {
    return x.closest.distance_m < y.closest.distance_m;
  });
  return pairs;
}

}  // namespace carom::demos
