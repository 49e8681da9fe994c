#pragma once
// What tests of closest features ask of solids and pairs.

#include <vector>

#include "engine/closest_features/pair/feature.h"
#include "engine/closest_features/pair/polyhedron_pair.h"

namespace carom {

inline std::vector<Feature> allFeatures(const ConvexPolyhedron& p) {
  std::vector<Feature> all;
  for (int v = 0; v < p.vertexCount(); ++v) all.push_back(vertexFeature(v));
  for (int e = 0; e < p.edgeCount(); ++e) all.push_back(edgeFeature(e));
  for (int f = 0; f < p.faceCount(); ++f) all.push_back(faceFeature(f));
  return all;
}

/// What a query calls the size of a pair, to which rounding is relative.
inline double sizeOf(const PolyhedronPair& pair) {
  return pair.t_AB.lpNorm<1>() + pair.a.reach() + pair.b.reach();
}

}  // namespace carom
