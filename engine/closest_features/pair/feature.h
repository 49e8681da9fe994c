#pragma once
// A feature of a convex polyhedron (paper §2) and a pair of them, the unit that V-Clip tracks.

#include <cstdint>

namespace carom {

enum class FeatureKind : std::uint8_t { kVertex = 0, kEdge = 1, kFace = 2 };

struct Feature {
  FeatureKind kind = FeatureKind::kVertex;
  int index = -1;  ///< -1: none.
  friend bool operator==(const Feature&, const Feature&) = default;
};

inline Feature vertexFeature(int v) {
  return {FeatureKind::kVertex, v};
}
inline Feature edgeFeature(int e) {
  return {FeatureKind::kEdge, e};
}
inline Feature faceFeature(int f) {
  return {FeatureKind::kFace, f};
}

struct FeaturePair {
  Feature a;
  Feature b;
  friend bool operator==(const FeaturePair&, const FeaturePair&) = default;
};

}  // namespace carom
