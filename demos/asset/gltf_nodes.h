#pragma once
// The tree of nodes of a glTF file (.gltf, .glb) in the digits that are written there. assimp multiplies
// scale, rotation and translation in single precision, on some processors with one rounding in place of two,
// so that the same file would be another body there. Source: Khronos Group, glTF 2.0, section 3.5.
// Tested in tests/demos/asset/gltf_nodes_test.cpp.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom::demos {

/// An affine map of points from one frame to another.
struct AffineMap {
  Mat3 linear = Mat3::Identity();
  Vec3 origin = Vec3::Zero();

  Vec3 operator*(const Vec3& p) const { return linear * p + origin; }
  AffineMap operator*(const AffineMap& inner) const { return {linear * inner.linear, *this * inner.origin}; }
};

struct GltfNode {
  AffineMap X_PN;             ///< From the node's frame to its parent's.
  std::vector<int> children;  ///< Of GltfNodes::nodes; a file may name what is not there, and go in circles.
};

struct GltfNodes {
  std::vector<GltfNode> nodes;
  int root = -1;  ///< That of the file's scene, or one more that holds all of them; -1 for none.
};

/// The JSON of such a file, which is a chunk of a binary one.
std::string gltfText(const std::filesystem::path& path);

/// None for a file of another format, and for one that is not as its format says.
GltfNodes gltfNodes(const std::filesystem::path& path);

}  // namespace carom::demos
