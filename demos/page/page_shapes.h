#pragma once
// The bodies' shapes as they are drawn, as a page holds them: the renderer's own triangles and normals
// (renderer/mesh), rounded to a 65535th of the shape's sides (to three halves of that where a mesh is
// shared), one mesh for all that are the same but for size. Read by web/recording.js. Tested in
// tests/demos/page/page_shapes_test.cpp.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "demos/page/byte_stream.h"
#include "demos/page/page_pictures.h"
#include "demos/scene/scene_world.h"

namespace carom::demos {

/// The mesh of a body: its number, and where its corners at (0, 0, 0) and (65535, 65535, 65535) are.
struct PlacedMesh {
  int mesh = 0;
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();
};

/// A mesh as it is written.
struct WrittenMesh {
  std::array<std::vector<std::int64_t>, 5> columns;  ///< Positions (3), folded normals (2).
  std::array<std::vector<std::int64_t>, 3> colors;   ///< Empty where all are white, as the next.
  std::array<std::vector<std::int64_t>, 3> places;   ///< On pictures: across, down, the layer or -1.
  std::vector<std::int64_t> corners;                 ///< Of triangles.
};

class PageShapes {
 public:
  /// The pictures that bodies are covered with go to `pictures`.
  PageShapes(const SceneWorld& scene, PagePictures& pictures);

  /// Of a body.
  const PlacedMesh& of(std::size_t body) const { return placed_.at(solids_[body]); }
  /// The number of meshes, then of each: vertices, triangles, whether it has colours of its own, whether it
  /// has places on pictures; columns of positions (3), normals folded onto a square (2), colours (3), places
  /// (2; in 65536ths of the picture's sides) with their layers, and corners of triangles, as differences.
  void write(ByteStream& out) const;

 private:
  std::vector<int> solids_;           // that are drawn, of the bodies
  std::map<int, PlacedMesh> placed_;  // of these
  std::vector<WrittenMesh> meshes_;
};

/// The height of the endless ground: the lowest level top of a static checker board; none without one.
struct PageGround {
  int body = 0;
  double z_m = 0.0;
};
std::optional<PageGround> pageGround(const SceneWorld& scene);

}  // namespace carom::demos
