#include "engine/closest_features/separated/exhaustive_search.h"

namespace carom {
namespace {

bool holds(const ConvexPolyhedron& polyhedron, const Vec3& p) {
  for (int f = 0; f < polyhedron.faceCount(); ++f)
    if (polyhedron.plane(f).signedDistance(p) > 0.0) return false;
  return polyhedron.faceCount() > 0;
}

}  // namespace

FeatureDistance exhaustiveSearch(const PolyhedronPair& pair) {
  FeatureDistance best = featureDistance(pair, {vertexFeature(0), vertexFeature(0)});
  const auto consider = [&](FeaturePair features) {
    const FeatureDistance d = featureDistance(pair, features);
    if (d.crossing || (!d.behind && !best.crossing && d.squared_m2 < best.squared_m2)) best = d;
  };
  for (int i = 0; i < pair.a.vertexCount(); ++i)
    for (int j = 0; j < pair.b.vertexCount(); ++j) consider({vertexFeature(i), vertexFeature(j)});
  for (int i = 0; i < pair.a.edgeCount(); ++i) {
    for (int j = 0; j < pair.b.vertexCount(); ++j) consider({edgeFeature(i), vertexFeature(j)});
    for (int j = 0; j < pair.b.edgeCount(); ++j) consider({edgeFeature(i), edgeFeature(j)});
    for (int j = 0; j < pair.b.faceCount(); ++j) consider({edgeFeature(i), faceFeature(j)});
  }
  for (int j = 0; j < pair.b.edgeCount(); ++j) {
    for (int i = 0; i < pair.a.vertexCount(); ++i) consider({vertexFeature(i), edgeFeature(j)});
    for (int i = 0; i < pair.a.faceCount(); ++i) consider({faceFeature(i), edgeFeature(j)});
  }
  for (int i = 0; i < pair.a.faceCount(); ++i)
    for (int j = 0; j < pair.b.vertexCount(); ++j) consider({faceFeature(i), vertexFeature(j)});
  for (int j = 0; j < pair.b.faceCount(); ++j)
    for (int i = 0; i < pair.a.vertexCount(); ++i) consider({vertexFeature(i), faceFeature(j)});
  if (holds(pair.a, pair.toA(pair.b.vertex(0))) || holds(pair.b, pair.toB(pair.a.vertex(0))))
    best.crossing = true;
  return best;
}

}  // namespace carom
