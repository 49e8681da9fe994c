#include "renderer/draw/scene_geometry.h"

#include <algorithm>
#include <limits>

#include "renderer/mesh/curved_part_mesh.h"
#include "renderer/mesh/solid_mesh.h"

namespace carom::renderer {
namespace {

struct Level {
  double max_radius_px;  // Used up to this radius on the image.
  int segments;          // Around balls, capsules and roundings.
  Edges edges;
};
constexpr std::array<Level, kDetailLevels> kLevels = {
    {{14.0, 12, Edges::kSharp},
     {40.0, 20, Edges::kShaded},
     {120.0, 36, Edges::kShaded},
     {350.0, 64, Edges::kBevelled},
     {std::numeric_limits<double>::infinity(), 128, Edges::kBevelled}}};

constexpr double kBevelCapFraction =
    0.05;  // Of the typical solid's width: large grounds get no wider bevels.

// Whether some part has triangles by `segments`.
bool hasRounding(const Solid& solid) {
  for (std::size_t i = 0; i < solid.parts().size(); ++i)
    if (!solid.isPiece(i) && solid.parts()[i].radius_m > 0.0) return true;
  return false;
}

// A twentieth of the median of the solids' narrowest parts.
double bevelCap(std::span<const Solid> solids) {
  constexpr double kUncapped = std::numeric_limits<double>::infinity();
  if (solids.empty()) return kUncapped;
  std::vector<double> bevels;
  for (const Solid& solid : solids) bevels.push_back(kBevelCapFraction * thinnestPart(solid));
  const auto middle = bevels.begin() + static_cast<std::ptrdiff_t>((bevels.size() - 1) / 2);
  std::nth_element(bevels.begin(), middle, bevels.end());
  return *middle;
}

// All meshes one behind the other.
struct Pool {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;

  MeshRange add(const TriangleMesh& mesh) {
    MeshRange range{indices.size() * sizeof(std::uint32_t), static_cast<GLsizei>(mesh.indices.size()),
                    static_cast<GLint>(vertices.size())};
    for (int i = 0; i < 3 && !mesh.vertices.empty(); ++i) {
      const auto [low, high] = std::minmax_element(
          mesh.vertices.begin(), mesh.vertices.end(),
          [i](const MeshVertex& a, const MeshVertex& b) { return a.position[i] < b.position[i]; });
      range.center[i] = 0.5f * (low->position[i] + high->position[i]);
      range.half[i] = 0.5f * (high->position[i] - low->position[i]);
    }
    vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    return range;
  }
};

SolidGeometry addSolid(Pool& pool, const Solid& solid, double bevel_cap_m) {
  SolidGeometry geometry;
  geometry.extent = solidExtent(solid);
  geometry.is_round = hasRoundPart(solid);
  geometry.is_ball = isBall(solid);
  geometry.boxes = occludingBoxes(solid);
  geometry.flat_parts = pool.add(buildFlatMesh(solid));
  const double bevel = bevelWidth(solid, bevel_cap_m);
  geometry.bevel_m = hasRounding(solid) ? std::numeric_limits<double>::infinity() : bevel;
  geometry.is_curved = solid.parts().size() == 1 && isCurved(solid.parts().front().core);
  for (std::size_t i = 0; i < kLevels.size(); ++i) {
    const auto& [radius, segments, edges] = kLevels[i];
    const bool sized = hasRounding(solid);  // Without, levels with the same edges are the same.
    const bool same = i > 0 && !sized && edges == kLevels[i - 1].edges;
    geometry.levels[i] = same ? geometry.levels[i - 1] : pool.add(buildMesh(solid, {edges, bevel, segments}));
    if (edges != Edges::kShaded)
      geometry.casting[i] = geometry.levels[i];
    else
      geometry.casting[i] =
          sized ? pool.add(buildMesh(solid, {Edges::kSharp, 0.0, segments})) : geometry.levels[0];
  }
  return geometry;
}

const void* offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

}  // namespace

int detailLevel(double radius_px) {
  int level = 0;
  while (radius_px > kLevels[static_cast<std::size_t>(level)].max_radius_px) ++level;
  return level;
}

bool drawsSingleFaces(int level) {
  return kLevels[static_cast<std::size_t>(level)].edges != Edges::kBevelled;
}

SceneGeometry::SceneGeometry(const GlFunctions& gl, std::span<const Solid> solids) {
  Pool pool;
  const double cap = bevelCap(solids);
  for (const Solid& solid : solids) {
    const std::size_t first = pool.vertices.size();
    solids_.push_back(addSolid(pool, solid, cap));
    const std::vector<SurfacePicture>& pictures = solid.surface().pictures;
    std::vector<float> layers;
    for (const SurfacePicture& picture : pictures)
      layers.push_back(static_cast<float>(pictures_.add(picture)));
    for (std::size_t i = first; i < pool.vertices.size() && !layers.empty(); ++i)
      if (float& layer = pool.vertices[i].picture[2]; layer >= 0.0f)
        layer = layers[static_cast<std::size_t>(layer)];
  }

  GLuint buffers[3];
  gl.GenBuffers(3, buffers);
  gl.GenVertexArrays(1, &vertex_array_);
  gl.BindVertexArray(vertex_array_);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(pool.vertices.size() * sizeof(MeshVertex)),
                pool.vertices.data(), GL_STATIC_DRAW);
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(MeshVertex),
                         offset(offsetof(MeshVertex, position)));
  gl.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(MeshVertex), offset(offsetof(MeshVertex, normal)));
  gl.VertexAttribPointer(6, 4, GL_FLOAT, GL_FALSE, sizeof(MeshVertex), offset(offsetof(MeshVertex, bend)));
  gl.VertexAttribPointer(10, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(MeshVertex),
                         offset(offsetof(MeshVertex, tint)));
  gl.VertexAttribIPointer(7, 1, GL_UNSIGNED_INT, sizeof(MeshVertex), offset(offsetof(MeshVertex, face)));
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(pool.indices.size() * sizeof(std::uint32_t)),
                pool.indices.data(), GL_STATIC_DRAW);
  instance_buffer_ = buffers[2];
  gl.BindBuffer(GL_ARRAY_BUFFER, instance_buffer_);
  for (GLuint i = 0; i < 4; ++i) {
    gl.VertexAttribPointer(2 + i, 4, GL_FLOAT, GL_FALSE, sizeof(InstanceRecord),
                           offset(4 * sizeof(float) * i));
    gl.VertexAttribDivisor(2 + i, 1);
  }
  gl.VertexAttribIPointer(8, 1, GL_UNSIGNED_INT, sizeof(InstanceRecord),
                          offset(offsetof(InstanceRecord, faces)));
  gl.VertexAttribIPointer(9, 1, GL_UNSIGNED_INT, sizeof(InstanceRecord),
                          offset(offsetof(InstanceRecord, sunlit)));
  gl.VertexAttribPointer(11, 4, GL_FLOAT, GL_FALSE, sizeof(InstanceRecord),
                         offset(offsetof(InstanceRecord, finish)));
  gl.VertexAttribPointer(12, 4, GL_FLOAT, GL_FALSE, sizeof(InstanceRecord),
                         offset(offsetof(InstanceRecord, half)));
  for (const GLuint i : {8u, 9u, 11u, 12u}) gl.VertexAttribDivisor(i, 1);
  for (GLuint i = 0; i < 13; ++i) gl.EnableVertexAttribArray(i);
  if (pictures_.empty()) return;
  gl.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  gl.VertexAttribPointer(15, 3, GL_FLOAT, GL_FALSE, sizeof(MeshVertex),
                         offset(offsetof(MeshVertex, picture)));
  gl.EnableVertexAttribArray(15);
  pictures_.upload(gl);
}

void SceneGeometry::uploadInstances(const GlFunctions& gl, std::span<const InstanceRecord> records) const {
  gl.BindBuffer(GL_ARRAY_BUFFER, instance_buffer_);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(records.size_bytes()), records.data(),
                GL_STREAM_DRAW);
}

void SceneGeometry::draw(const GlFunctions& gl, const MeshRange& range, int first_instance, int count) const {
  gl.BindVertexArray(vertex_array_);
  gl.DrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, range.count, GL_UNSIGNED_INT,
                                                 offset(range.first_byte), count, range.base_vertex,
                                                 static_cast<GLuint>(first_instance));
}

}  // namespace carom::renderer
