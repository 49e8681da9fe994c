#include "demos/record/motion_gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <sstream>
#include <tuple>

#include <tiny_gltf.h>

#include "demos/format/formatted.h"
#include "demos/system/build_info.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"
#include "renderer/image/png.h"
#include "renderer/mesh/solid_mesh.h"
#include "renderer/view/projection.h"

namespace carom::demos {
namespace {

constexpr double kMostMotionBytes = 0x1p30;  // A .glb counts its bytes in 32 bits.
constexpr double kBytesOfKey = 7 * sizeof(float);
constexpr int kRoundSegments = 48;
constexpr double kRoughness = 0.8;
constexpr double kCameraAspect = 16.0 / 9.0;
constexpr double kNearOverDistance = 0.01;  // Of the distance from eye to target, as the next.
constexpr double kFarOverDistance = 1000.0;
constexpr std::size_t kXyz = 3;
constexpr std::size_t kXyzw = 4;

std::vector<double> numbers(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// In glTF's order.
std::vector<double> numbers(const Quat& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

/// The arrays of the one buffer, each aligned to its four-byte elements.
class Accessors {
 public:
  explicit Accessors(tinygltf::Model& model) : model_(model) { model.buffers.emplace_back(); }

  /// `width` numbers an element, 1 for scalars. Index of the accessor.
  int add(std::span<const float> values, std::size_t width, int target) {
    tinygltf::Accessor accessor;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    constexpr int kTypes[] = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                              TINYGLTF_TYPE_VEC4};
    accessor.type = kTypes[width - 1];
    accessor.count = values.size() / width;
    for (std::size_t i = 0; i < width; ++i) {
      float least = values[i], most = values[i];
      for (std::size_t k = i; k < values.size(); k += width) {
        least = std::min(least, values[k]);
        most = std::max(most, values[k]);
      }
      accessor.minValues.push_back(static_cast<double>(least));
      accessor.maxValues.push_back(static_cast<double>(most));
    }
    return push(std::move(accessor), std::as_bytes(values), target);
  }

  /// Index of the bytes' view.
  int addFile(const std::vector<std::uint8_t>& bytes) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = bytes.size();
    data.insert(data.end(), bytes.begin(), bytes.end());
    data.resize((data.size() + 3) / 4 * 4);  // What follows has elements of four bytes.
    model_.bufferViews.push_back(std::move(view));
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  int addIndices(std::span<const std::uint32_t> indices) {
    tinygltf::Accessor accessor;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = indices.size();
    return push(std::move(accessor), std::as_bytes(indices), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  }

 private:
  int push(tinygltf::Accessor accessor, std::span<const std::byte> bytes, int target) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = bytes.size();
    view.target = target;
    data.resize(data.size() + bytes.size());
    std::memcpy(data.data() + view.byteOffset, bytes.data(), bytes.size());
    model_.bufferViews.push_back(std::move(view));
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  tinygltf::Model& model_;
};

/// "#rrggbb"
std::string hexColor(const renderer::Color& color) {
  const auto byte = [](float channel) { return static_cast<int>(std::lround(255.0f * channel)); };
  return formatted("#%02x%02x%02x", byte(color.r), byte(color.g), byte(color.b));
}

/// Bodies of the same material and colour share one of the file's materials.
using MaterialKey = std::pair<std::string, std::string>;
MaterialKey materialKey(const SurfaceLook& look) {
  return {look.material, hexColor(look.color)};
}

/// The scene's name of a material, with the colour where copies have several or there is no name.
std::map<MaterialKey, int> addMaterials(tinygltf::Model& model, const SceneWorld& world) {
  std::map<MaterialKey, int> indices;
  std::map<std::string, int> colors_of;
  for (const SurfaceLook& look : world.looks)
    if (indices.emplace(materialKey(look), -1).second) ++colors_of[look.material];
  for (const SurfaceLook& look : world.looks) {
    int& index = indices[materialKey(look)];
    if (index >= 0) continue;
    index = static_cast<int>(model.materials.size());
    tinygltf::Material material;
    material.name = look.material;
    if (look.material.empty()) material.name = hexColor(look.color);
    if (!look.material.empty() && colors_of[look.material] > 1) material.name += " " + hexColor(look.color);
    const renderer::Color& c = look.color;
    material.pbrMetallicRoughness.baseColorFactor = {renderer::linearLight(c.r), renderer::linearLight(c.g),
                                                     renderer::linearLight(c.b), 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = kRoughness;
    model.materials.push_back(std::move(material));
  }
  return indices;
}

/// Triangles that are covered with the same picture of their solid, or with none.
struct SolidPrimitive {
  tinygltf::Primitive primitive;
  int picture = -1;
};

/// The triangles of a solid in its own frame, as they are drawn; edges are sharp, as in the simulation.
std::vector<SolidPrimitive> solidPrimitives(Accessors& accessors, const Solid& solid) {
  const renderer::TriangleMesh mesh =
      renderer::buildMesh(solid, {renderer::Edges::kSharp, 0.0, kRoundSegments});
  std::vector<float> positions, normals, colors, places;
  for (const renderer::MeshVertex& v : mesh.vertices) {
    positions.insert(positions.end(), v.position, v.position + kXyz);
    normals.insert(normals.end(), v.normal, v.normal + kXyz);
    for (std::size_t i = 0; i < kXyz; ++i) colors.push_back(static_cast<float>(v.tint[i]) / 255.0f);
    places.insert(places.end(), v.picture, v.picture + 2);
  }
  std::map<int, std::vector<std::uint32_t>> by_picture;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::vector<std::uint32_t>& into =
        by_picture[static_cast<int>(mesh.vertices[mesh.indices[i]].picture[2])];
    into.insert(into.end(), &mesh.indices[i], &mesh.indices[i] + 3);
  }
  tinygltf::Primitive shared;
  shared.mode = TINYGLTF_MODE_TRIANGLES;
  shared.attributes["POSITION"] = accessors.add(positions, kXyz, TINYGLTF_TARGET_ARRAY_BUFFER);
  shared.attributes["NORMAL"] = accessors.add(normals, kXyz, TINYGLTF_TARGET_ARRAY_BUFFER);
  if (!solid.surface().colors.empty())
    shared.attributes["COLOR_0"] = accessors.add(colors, kXyz, TINYGLTF_TARGET_ARRAY_BUFFER);
  if (!solid.surface().uv.empty())
    shared.attributes["TEXCOORD_0"] = accessors.add(places, 2, TINYGLTF_TARGET_ARRAY_BUFFER);
  std::vector<SolidPrimitive> primitives;
  for (const auto& [picture, indices] : by_picture) {
    primitives.push_back({shared, picture});
    primitives.back().primitive.indices = accessors.addIndices(indices);
  }
  return primitives;
}

/// The index of the picture as a texture.
int addTexture(tinygltf::Model& model, Accessors& accessors, const SurfacePicture& picture) {
  tinygltf::Image image;
  image.mimeType = "image/png";
  image.bufferView = accessors.addFile(
      renderer::encodeSmallPng(renderer::Image{picture.width, picture.height, picture.rgb}));
  tinygltf::Texture texture;
  texture.source = static_cast<int>(model.images.size());
  model.images.push_back(std::move(image));
  model.textures.push_back(std::move(texture));
  return static_cast<int>(model.textures.size()) - 1;
}

/// What covers bodies: materials of the scene, each again with every picture that it is seen with.
class Covers {
 public:
  Covers(tinygltf::Model& model, Accessors& accessors, const SceneWorld& world)
      : model_(model), accessors_(accessors), world_(world) {}

  /// `drawn` is the number of a drawn solid.
  int of(int material, int drawn, int picture) {
    if (picture < 0) return material;
    const auto [known, is_new] = materials_.try_emplace({material, drawn, picture}, -1);
    if (!is_new) return known->second;
    const auto [texture, unknown] = textures_.try_emplace({drawn, picture}, -1);
    if (unknown) texture->second = textureOf(pictureOf(drawn, picture));
    tinygltf::Material covered = model_.materials[static_cast<std::size_t>(material)];
    covered.name += " picture " + std::to_string(texture->second + 1);
    covered.pbrMetallicRoughness.baseColorTexture.index = texture->second;
    known->second = static_cast<int>(model_.materials.size());
    model_.materials.push_back(std::move(covered));
    return known->second;
  }

 private:
  const SurfacePicture& pictureOf(int drawn, int picture) const {
    return world_.drawnSolids()[static_cast<std::size_t>(drawn)]
        .surface()
        .pictures[static_cast<std::size_t>(picture)];
  }
  /// Equal pictures of several solids are one.
  int textureOf(const SurfacePicture& picture) {
    for (const auto& [where, texture] : textures_)
      if (texture >= 0 && pictureOf(where.first, where.second) == picture) return texture;
    return addTexture(model_, accessors_, picture);
  }

  tinygltf::Model& model_;
  Accessors& accessors_;
  const SceneWorld& world_;
  std::map<std::tuple<int, int, int>, int> materials_;
  std::map<std::pair<int, int>, int> textures_;
};

/// "crate" of "crate[7]": the name that the copies of a body share.
std::string sharedName(const std::string& name) {
  return name.ends_with(']') ? name.substr(0, name.rfind('[')) : name;
}

/// The mesh of each body; bodies of one solid share its triangles, those of one material as well share the
/// mesh.
std::vector<int> addMeshes(tinygltf::Model& model, Accessors& accessors, const SceneWorld& world) {
  const std::map<MaterialKey, int> materials = addMaterials(model, world);
  Covers covers(model, accessors, world);
  std::map<int, std::vector<SolidPrimitive>> primitives;
  std::map<std::pair<int, int>, int> meshes;
  std::vector<int> of_body;
  for (std::size_t i = 0; i < world.names.size(); ++i) {
    const int solid = world.drawnSolid(i);
    const int material = materials.at(materialKey(world.looks[i]));
    if (!primitives.contains(solid))
      primitives[solid] = solidPrimitives(accessors, world.drawnSolids()[static_cast<std::size_t>(solid)]);
    const auto [mesh, is_new] = meshes.try_emplace({solid, material}, static_cast<int>(model.meshes.size()));
    of_body.push_back(mesh->second);
    if (!is_new) continue;
    tinygltf::Mesh added;
    added.name = sharedName(world.names[i]);
    for (const SolidPrimitive& part : primitives[solid]) {
      added.primitives.push_back(part.primitive);
      added.primitives.back().material = covers.of(material, solid, part.picture);
    }
    model.meshes.push_back(std::move(added));
  }
  return of_body;
}

/// Names as in the scene's file.
tinygltf::Value physics(const BodyDescription& body) {
  const Material& m = body.material;
  tinygltf::Value::Object values({{"staticFriction", tinygltf::Value(m.static_friction)},
                                  {"dynamicFriction", tinygltf::Value(m.dynamic_friction)},
                                  {"rollingResistance", tinygltf::Value(m.rolling_resistance_m)},
                                  {"spinningResistance", tinygltf::Value(m.spinning_resistance_m)},
                                  {"restitution", tinygltf::Value(m.restitution)},
                                  {"density", tinygltf::Value(m.density_kgpm3)},
                                  {"static", tinygltf::Value(body.is_static)}});
  if (body.is_kinematic) values["kinematic"] = tinygltf::Value(true);
  return tinygltf::Value(values);
}

/// Appends a node below the first one, which is the root.
int addNode(tinygltf::Model& model, tinygltf::Node node) {
  const int index = static_cast<int>(model.nodes.size());
  if (index > 0) model.nodes[0].children.push_back(index);
  model.nodes.push_back(std::move(node));
  return index;
}

/// Turns z-up to y-up: x stays, z becomes y, y becomes -z.
void addRoot(tinygltf::Model& model, const std::string& name) {
  tinygltf::Node root;
  root.name = name;
  root.rotation = {-std::numbers::sqrt2 / 2.0, 0.0, 0.0, std::numbers::sqrt2 / 2.0};
  tinygltf::Scene scene;
  scene.name = name;
  scene.nodes.push_back(addNode(model, std::move(root)));
  model.scenes.push_back(std::move(scene));
  model.defaultScene = 0;
}

/// glTF's cameras look along their -z with y up.
Quat cameraRotation(const renderer::Camera& camera) {
  const renderer::CameraAxes axes = renderer::cameraAxes(camera);
  Mat3 R_WC;
  R_WC << axes.right, axes.up, -axes.forward;
  return Quat(R_WC).normalized();
}

/// The number of its node.
int addCamera(tinygltf::Model& model, const std::string& name, const renderer::Camera& camera) {
  tinygltf::Camera lens;
  lens.name = name;
  lens.type = "perspective";
  lens.perspective.yfov = camera.fov_degrees * std::numbers::pi / 180.0;
  lens.perspective.aspectRatio = kCameraAspect;
  const double distance_m = (camera.target - camera.eye).norm();
  lens.perspective.znear = kNearOverDistance * distance_m;
  lens.perspective.zfar = kFarOverDistance * distance_m;
  tinygltf::Node node;
  node.name = "camera " + name;
  node.camera = static_cast<int>(model.cameras.size());
  node.translation = numbers(camera.eye);
  node.rotation = numbers(cameraRotation(camera));
  model.cameras.push_back(std::move(lens));
  return addNode(model, std::move(node));
}

void addChannel(tinygltf::Animation& animation, int node, const char* path,
                const std::pair<int, int>& times_values) {
  tinygltf::AnimationSampler sampler;
  sampler.input = times_values.first;
  sampler.output = times_values.second;
  sampler.interpolation = "LINEAR";
  tinygltf::AnimationChannel channel;
  channel.sampler = static_cast<int>(animation.samplers.size());
  channel.target_node = node;
  channel.target_path = path;
  animation.samplers.push_back(std::move(sampler));
  animation.channels.push_back(std::move(channel));
}

}  // namespace

MotionGltf::MotionGltf(const Scene& scene, const SceneWorld& world, int frames)
    : scene_(scene), world_(world) {
  for (std::size_t i = 0; i < world.names.size(); ++i)
    if (!world.world.bodies()[i].is_static) tracks_.push_back({{}, i});
  for (const auto& [name, camera] : scene.cameras)
    cameras_.push_back({{}, name, CameraPath(camera, world, kCameraAspect), camera.moves(), camera});
  const double needed = frames * (sizeof(float) + static_cast<double>(tracks_.size()) * kBytesOfKey);
  if (needed > kMostMotionBytes)
    throw UsageError(std::to_string(frames) + " frames of " + std::to_string(tracks_.size()) +
                     " moving bodies do not fit into a .glb file; accepted: at most 1 GiB of motion (fewer "
                     "--fps, a shorter --duration)");
}

void MotionGltf::add(double time_s, std::span<const BodyState> states) {
  if (first_.empty())
    for (const BodyState& state : states) first_.push_back(state.X_WB);
  times_s_.push_back(static_cast<float>(time_s));
  for (BodyTrack& track : tracks_) {
    const Pose& X_WB = states[track.body].X_WB;
    track.add(X_WB.position, X_WB.rotation);
  }
  for (CameraTrack& track : cameras_) {
    const renderer::Camera camera = track.path.at(time_s, states);
    if (times_s_.size() == 1) track.first = camera;
    if (track.moves) track.add(camera.eye, cameraRotation(camera));
  }
}

void MotionGltf::Track::add(const Vec3& position, const Quat& rotation) {
  for (const double x : position) translations.push_back(static_cast<float>(x));
  Eigen::Vector4f xyzw = rotation.coeffs().cast<float>();
  const std::size_t held = rotations.size();
  if (held > 0 && xyzw.dot(Eigen::Map<Eigen::Vector4f>(&rotations[held - kXyzw])) < 0.0f) xyzw = -xyzw;
  rotations.insert(rotations.end(), xyzw.begin(), xyzw.end());
}

std::string MotionGltf::bytes() const {
  REQUIRE(!times_s_.empty());
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "carom " + programVersion();
  Accessors accessors(model);
  addRoot(model, scene_.name);
  const std::vector<int> mesh_of = addMeshes(model, accessors, world_);
  for (std::size_t i = 0; i < mesh_of.size(); ++i) {
    tinygltf::Node node;
    node.name = world_.names[i];
    node.mesh = mesh_of[i];
    node.translation = numbers(first_[i].position);
    node.rotation = numbers(first_[i].rotation);
    node.extras = physics(world_.world.bodies()[i]);
    addNode(model, std::move(node));
  }
  std::vector<int> camera_nodes;
  for (const CameraTrack& track : cameras_) camera_nodes.push_back(addCamera(model, track.name, track.first));

  tinygltf::Animation animation;
  animation.name = scene_.name;
  std::vector<std::pair<int, const Track*>> moving;
  for (const BodyTrack& track : tracks_) moving.emplace_back(1 + static_cast<int>(track.body), &track);
  for (std::size_t i = 0; i < cameras_.size(); ++i)
    if (cameras_[i].moves) moving.emplace_back(camera_nodes[i], &cameras_[i]);
  const int times = moving.empty() ? -1 : accessors.add(times_s_, 1, 0);
  for (const auto& [node, track] : moving) {
    addChannel(animation, node, "translation", {times, accessors.add(track->translations, kXyz, 0)});
    addChannel(animation, node, "rotation", {times, accessors.add(track->rotations, kXyzw, 0)});
  }
  if (!moving.empty()) model.animations.push_back(std::move(animation));

  std::ostringstream out;
  const bool written = tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, false, true);
  REQUIRE(written);
  return out.str();
}

}  // namespace carom::demos
