#pragma once
// Clips ears off a ring (Meisters 1975), the best-shaped first, and takes it apart where it touches itself.
// Tested in tests/engine/solid/decomposition/polygon_triangles_test.cpp.

#include <optional>
#include <vector>

#include "engine/solid/decomposition/joined_ring.h"

namespace carom {

/// Nothing where rounding leaves no ear. Corners nearer to a line than `tolerance_m` are on it.
std::optional<PolygonTriangles> clippedEars(const JoinedRing& joined, const std::vector<Vec2>& corners,
                                            double tolerance_m);

}  // namespace carom
