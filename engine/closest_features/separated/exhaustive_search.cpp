#include "engine/closest_features/separated/exhaustive_search.h"

namespace carom {
namespace {

bool holds(const ConvexPolyhedron& polyhedron, const Vec3& p) {
  for (int f = 0; f < polyhedron.faceCount(); ++f)
    if (polyhedron.plane(f).signedDistance(p) > 0.0) return false;
  return polyhedron.faceCount() > 0;
}

// The least distance so far.
class Nearest {
 public:
  explicit Nearest(const PolyhedronPair& pair)
      : pair_(pair), best_(featureDistance(pair, {vertexFeature(0), vertexFeature(0)})) {}

  // A feature of A with all of one kind of B's, and the other way round.
  void withAllOfB(Feature a, FeatureKind kind, int count) {
    for (int j = 0; j < count; ++j) consider({a, {kind, j}});
  }
  void withAllOfA(FeatureKind kind, int count, Feature b) {
    for (int i = 0; i < count; ++i) consider({{kind, i}, b});
  }
  const FeatureDistance& best() const { return best_; }

 private:
  void consider(FeaturePair features) {
    const FeatureDistance d = featureDistance(pair_, features);
    if (d.crossing || (!d.behind && !best_.crossing && d.squared_m2 < best_.squared_m2)) best_ = d;
  }

  const PolyhedronPair& pair_;
  FeatureDistance best_;
};

}  // namespace

FeatureDistance exhaustiveSearch(const PolyhedronPair& pair) {
  const ConvexPolyhedron &a = pair.a, &b = pair.b;
  Nearest nearest(pair);
  for (int i = 0; i < a.vertexCount(); ++i)
    nearest.withAllOfB(vertexFeature(i), FeatureKind::kVertex, b.vertexCount());
  for (int i = 0; i < a.edgeCount(); ++i) {
    nearest.withAllOfB(edgeFeature(i), FeatureKind::kVertex, b.vertexCount());
    nearest.withAllOfB(edgeFeature(i), FeatureKind::kEdge, b.edgeCount());
    nearest.withAllOfB(edgeFeature(i), FeatureKind::kFace, b.faceCount());
  }
  for (int j = 0; j < b.edgeCount(); ++j) {
    nearest.withAllOfA(FeatureKind::kVertex, a.vertexCount(), edgeFeature(j));
    nearest.withAllOfA(FeatureKind::kFace, a.faceCount(), edgeFeature(j));
  }
  for (int i = 0; i < a.faceCount(); ++i)
    nearest.withAllOfB(faceFeature(i), FeatureKind::kVertex, b.vertexCount());
  for (int j = 0; j < b.faceCount(); ++j)
    nearest.withAllOfA(FeatureKind::kVertex, a.vertexCount(), faceFeature(j));
  FeatureDistance best = nearest.best();
  if (holds(a, pair.toA(b.vertex(0))) || holds(b, pair.toB(a.vertex(0)))) best.crossing = true;
  return best;
}

}  // namespace carom
