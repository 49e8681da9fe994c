#pragma once
// Makes the faces of an almost convex polyhedron planar: rounded coordinates bend a face of four or more
// corners. The vertices are moved as little as possible (least squares) onto common planes. There is always a
// solution nearby: 3V coordinates under one condition for each corner beyond a face's third leave E + 6
// degrees of freedom (Steinitz), so the conditions never contradict each other. Tested in
// tests/engine/solid/planar_faces_test.cpp.

#include <span>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom {

/// The largest distance of a corner from the plane that fits its face best, metres.
double largestBend(std::span<const Vec3> vertices, std::span<const std::vector<int>> loops);

/// Moves the vertices until no face bends more than rounding, as far as a bounded number of rounds gets.
/// Returns the largest distance that a vertex was moved, metres. Cost: O(corners) a sweep; a few sweeps for
/// faces at wide angles, as many as there are faces around a fine ring.
double flattenFaces(std::vector<Vec3>& vertices, std::span<const std::vector<int>> loops);

}  // namespace carom
