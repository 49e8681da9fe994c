#pragma once
// The directions that the way between two witnesses may really have, for all that rounding tells. Along level
// features the distance changes only in the second order, so the direction of the witnesses is uncertain by
// the root of rounding; the normals of level faces, and what is across two level edges, are exact. By duality
// no slab that is free of both bodies is wider than their distance, so the widest one tells. Tested in
// tests/engine/closest_features/canonical_features_test.cpp.

#include "engine/closest_features/pair/core_answer.h"
#include "engine/closest_features/penetrating/penetration.h"

namespace carom {

/// A vertex of the feature (of a face: any).
int vertexOf(const ConvexPolyhedron& polyhedron, Feature feature);

/// How wide the slab across unit `n` (frame of A, from A to B) is that is free of both bodies, metres.
double slabAlong(const PolyhedronPair& pair, const FeaturePair& start, const Vec3& n);

/// The axes at the features of an answer that are level with it, each with its slab.
void gatherLevelAxes(const PolyhedronPair& pair, const CoreAnswer& answer, double noise_m,
                     MinimumTranslations& axes);

}  // namespace carom
