#pragma once
// What the benchmarks ask of a collision library: the signed gap of one pair of hulls at prepared poses.
// Everything crosses in plain numbers, because a peer's linear algebra may lay out its types differently from
// ours. Each library is one adapter file, the only one that names it.

#include <array>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace carom {
struct ConvexPart;
}

namespace carom::bench {

/// A rotation as the unit quaternion w, x, y, z, and a position in metres.
struct PlainPose {
  std::array<double, 4> rotation_wxyz{1, 0, 0, 0};
  std::array<double, 3> position{0, 0, 0};
};

struct PosePair {
  PlainPose X_WA;
  PlainPose X_WB;
};

/// A convex polyhedron: faces are loops of vertex indices, counter-clockwise seen from outside.
struct Hull {
  const ConvexPart* part = nullptr;  ///< The same as our own engine keeps it.
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::vector<int>> faces;
};

/// The answer of a library that says "apart" and no more.
constexpr double kApart = std::numeric_limits<double>::infinity();

/// One pair of shapes in one library. The poses are brought into the library's own form before the clock
/// runs.
class PairQuery {
 public:
  virtual ~PairQuery() = default;
  virtual void setPoses(std::span<const PosePair> poses) = 0;
  /// Drops what is remembered from the last query, where a library remembers anything.
  virtual void forget() = 0;
  /// At pose i: the distance in metres, minus the depth when penetrating, kApart, or NaN for a failure.
  virtual double ask(std::size_t i) = 0;
};

enum class Gives {
  kDistance,  ///< Distance and depth.
  kContact    ///< Whether they touch, and the depth if so.
};

struct Library {
  std::string name;
  Gives gives = Gives::kDistance;
  double tolerance = 0.0;  ///< An answer off by more, relative to the pair's size, is wrong.
  std::unique_ptr<PairQuery> (*makePair)(const Hull& a, const Hull& b) = nullptr;
};

/// Ours first, then the peers that were found when this was built.
std::vector<Library> libraries();

}  // namespace carom::bench
