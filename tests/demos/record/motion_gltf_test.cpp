// Read back by assimp's importer, which shares no code with the writer, and compared with the engine.
#include "demos/record/motion_gltf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_file.h"
#include "demos/motion/frame_states.h"
#include "demos/system/exit_code.h"
#include "renderer/mesh/solid_mesh.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

constexpr double kFps = 30.0;
constexpr int kFrames = 20;
constexpr double kTolerance_m = 1e-5;  // The shipped scenes lie within 40 m: single precision is 2e-6 there.

/// What the file says of a world's point: z has become y.
Vec3 upright(const Vec3& p_W) {
  return {p_W.x(), p_W.z(), -p_W.y()};
}

Vec3 toVec3(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

Quat toQuat(const aiQuaternion& q) {
  return Quat(static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
              static_cast<double>(q.z));
}

/// A scene that was stepped for a while, its states, and the file of it.
struct Exported {
  explicit Exported(const Scene& described, int frames = kFrames)
      : scene(described), made(makeSceneWorld(scene, std::nullopt)) {
    const FrameClock clock({kFps, scene.rate_hz});
    FrameStates source(made.world, clock, [](const World&) {});
    MotionGltf motion(scene, made, frames);
    for (int frame = 0; frame < frames; ++frame) {
      const std::span<const BodyState> now = source.advanceTo(frame);
      states.emplace_back(now.begin(), now.end());
      motion.add(clock.time(frame), now);
    }
    bytes = motion.bytes();
    read = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "glb");
  }

  /// Children of the root are the bodies in order, then the cameras.
  const aiNode& node(std::size_t i) const { return *read->mRootNode->mChildren[i]; }
  const aiNodeAnim* channel(std::size_t body) const {
    const aiAnimation& animation = *read->mAnimations[0];
    for (unsigned c = 0; c < animation.mNumChannels; ++c)
      if (animation.mChannels[c]->mNodeName == node(body).mName) return animation.mChannels[c];
    return nullptr;
  }
  const Solid& solid(std::size_t body) const {
    return made.world.solids()[static_cast<std::size_t>(made.world.bodies()[body].solid)];
  }

  Scene scene;
  SceneWorld made;
  std::vector<std::vector<BodyState>> states;
  std::string bytes;
  Assimp::Importer importer;
  const aiScene* read = nullptr;
};

/// Where the file puts a point of a body at a key.
Vec3 shownPoint(const Exported& file, const aiNodeAnim& channel, unsigned key, const Vec3& p_B) {
  aiVector3D scaling, origin;
  aiQuaternion turn;
  file.read->mRootNode->mTransformation.Decompose(scaling, turn, origin);
  EXPECT_LT((toVec3(scaling) - Vec3::Ones()).norm(), 1e-6);
  const Vec3 local =
      toQuat(channel.mRotationKeys[key].mValue) * p_B + toVec3(channel.mPositionKeys[key].mValue);
  return toQuat(turn) * local + toVec3(origin);
}

void expectMotionOf(const Exported& file, std::size_t body) {
  const aiNodeAnim* channel = file.channel(body);
  ASSERT_NE(channel, nullptr) << file.made.names[body];
  ASSERT_EQ(channel->mNumPositionKeys, static_cast<unsigned>(kFrames));
  ASSERT_EQ(channel->mNumRotationKeys, static_cast<unsigned>(kFrames));
  for (unsigned k = 0; k < kFrames; ++k) {
    EXPECT_NEAR(channel->mPositionKeys[k].mTime / file.read->mAnimations[0]->mTicksPerSecond, k / kFps, 1e-6);
    const Pose& X_WB = file.states[k][body].X_WB;
    for (const Vec3& p_B : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      EXPECT_LT((shownPoint(file, *channel, k, p_B) - upright(X_WB * p_B)).norm(), kTolerance_m)
          << file.made.names[body] << " in frame " << k;
  }
}

void expectStillPoseOf(const Exported& file, std::size_t body) {
  EXPECT_EQ(file.channel(body), nullptr);
  const Pose& X_WB = file.states[0][body].X_WB;
  for (const Vec3& p_B : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
    const aiVector3D p(static_cast<float>(p_B.x()), static_cast<float>(p_B.y()), static_cast<float>(p_B.z()));
    const aiMatrix4x4 X = file.read->mRootNode->mTransformation * file.node(body).mTransformation;
    EXPECT_LT((toVec3(X * p) - upright(X_WB * p_B)).norm(), kTolerance_m) << file.made.names[body];
  }
}

void expectTrianglesOf(const Exported& file, std::size_t body) {
  ASSERT_EQ(file.node(body).mNumMeshes, 1u) << file.made.names[body];
  const aiMesh& mesh = *file.read->mMeshes[file.node(body).mMeshes[0]];
  const renderer::TriangleMesh built =
      renderer::buildMesh(file.solid(body), {renderer::Edges::kSharp, 0.0, 48});
  ASSERT_EQ(mesh.mNumVertices, built.vertices.size());
  ASSERT_EQ(mesh.mNumFaces, built.indices.size() / 3);
  double volume = 0.0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const unsigned* corner = mesh.mFaces[f].mIndices;
    const Vec3 a = toVec3(mesh.mVertices[corner[0]]), b = toVec3(mesh.mVertices[corner[1]]),
               c = toVec3(mesh.mVertices[corner[2]]);
    volume += a.dot(b.cross(c)) / 6.0;
    for (int k = 0; k < 3; ++k)
      EXPECT_GE((b - a).cross(c - a).dot(toVec3(mesh.mNormals[corner[k]])), -1e-9)
          << "normals and winding look outwards";
  }
  // Chords of 48 cut off a little of a ball; parts of a compound may overlap.
  EXPECT_LT(volume, 1.2 * file.solid(body).volume());
  EXPECT_GT(volume, 0.98 * file.solid(body).volume());
}

void expectColorOf(const Exported& file, std::size_t body) {
  const aiMesh& mesh = *file.read->mMeshes[file.node(body).mMeshes[0]];
  const aiMaterial& material = *file.read->mMaterials[mesh.mMaterialIndex];
  aiColor4D shown;
  ASSERT_EQ(material.Get(AI_MATKEY_BASE_COLOR, shown), aiReturn_SUCCESS);
  const SurfaceLook& look = file.made.looks[body];
  const auto linear = [](float s) {
    return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
  };
  EXPECT_NEAR(shown.r, linear(look.color.r), 1e-6f);
  EXPECT_NEAR(shown.g, linear(look.color.g), 1e-6f);
  EXPECT_NEAR(shown.b, linear(look.color.b), 1e-6f);
  aiString name;
  material.Get(AI_MATKEY_NAME, name);
  EXPECT_EQ(std::string(name.C_Str()).rfind(look.material, 0), 0u) << name.C_Str();
}

void expectCamera(const Exported& file, const std::string& name, const renderer::Camera& camera) {
  const aiCamera* shown = nullptr;
  const aiNode* node = file.read->mRootNode->FindNode(("camera " + name).c_str());
  ASSERT_NE(node, nullptr) << name;
  for (unsigned i = 0; i < file.read->mNumCameras; ++i)
    if (file.read->mCameras[i]->mName == node->mName) shown = file.read->mCameras[i];
  ASSERT_NE(shown, nullptr) << name;
  const aiMatrix4x4 X = file.read->mRootNode->mTransformation * node->mTransformation;
  // assimp repeats the node's place in the camera's own; the node alone is what counts.
  const Vec3 eye = toVec3(X * aiVector3D(0, 0, 0));
  const aiMatrix3x3 turn(X);
  const Vec3 forward = toVec3(turn * shown->mLookAt), up = toVec3(turn * shown->mUp);
  EXPECT_LT((eye - upright(camera.eye)).norm(), kTolerance_m);
  EXPECT_LT((forward - upright((camera.target - camera.eye).normalized())).norm(), 1e-6);
  EXPECT_GT(up.y(), 0.0);
  EXPECT_GT(shown->mClipPlaneNear, 0.0f);
  EXPECT_GT(shown->mClipPlaneFar, shown->mClipPlaneNear);
  EXPECT_NEAR(up.dot(forward), 0.0, 1e-6);
  // assimp 5.2 widens the angle itself by the aspect ratio, later versions its tangent.
  const double across = shown->mHorizontalFOV, aspect = shown->mAspect, degree = std::numbers::pi / 180.0;
  const double by_angle = across / aspect, by_tangent = 2.0 * std::atan(std::tan(across / 2.0) / aspect);
  EXPECT_LT(std::min(std::abs(by_angle / degree - camera.fov_degrees),
                     std::abs(by_tangent / degree - camera.fov_degrees)),
            1e-4);
}

class ShippedScene : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedScene, ReadBackByAssimpMovesAndLooksAsInTheEngine) {
  const Exported file(readSceneFile(GetParam()));
  ASSERT_NE(file.read, nullptr) << file.importer.GetErrorString();
  ASSERT_EQ(file.read->mRootNode->mNumChildren, file.made.names.size() + file.scene.cameras.size());
  ASSERT_EQ(file.read->mNumAnimations, 1u);
  for (std::size_t i = 0; i < file.made.names.size(); ++i) {
    EXPECT_EQ(file.node(i).mName.C_Str(), file.made.names[i]);
    if (file.made.world.bodies()[i].is_static)
      expectStillPoseOf(file, i);
    else
      expectMotionOf(file, i);
    expectTrianglesOf(file, i);
    expectColorOf(file, i);
  }
  for (const auto& [name, camera] : file.scene.cameras) expectCamera(file, name, camera);
}

INSTANTIATE_TEST_SUITE_P(MotionGltf, ShippedScene, testing::ValuesIn(shippedScenes()),
                         [](const auto& shipped) {
                           std::string name = shipped.param.stem().string();
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

/// A floor and copies of a body that spins by more than a turn.
Scene spinningScene() {
  Scene scene;
  scene.name = "spinning";
  Body die;
  die.name = "die";
  die.shape.form = BoxShape{Vec3(0.3, 0.4, 0.5)};
  die.X_WS.position = Vec3(1, 2, 30);
  die.angular_velocity = Vec3(3, -20, 7);
  die.look.material = "bone";
  die.colors = {{1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  die.repeat.count[0] = 4;
  die.repeat.step_m = Vec3(2, 0, 0);
  scene.bodies.push_back(die);
  scene.cameras["main"] = renderer::Camera();
  return scene;
}

TEST(MotionGltf, RotationsTakeTheSignNearestToTheLast) {
  const Scene scene = spinningScene();
  const SceneWorld made = makeSceneWorld(scene, std::nullopt);
  std::vector<BodyState> states(made.world.states().begin(), made.world.states().end());
  const Quat turned(0.5, 0.5, -0.5, 0.5);
  MotionGltf motion(scene, made, 4);
  for (int frame = 0; frame < 4; ++frame) {
    states[0].X_WB.rotation = frame % 2 == 0 ? turned : Quat(-turned.coeffs());
    motion.add(frame, states);
  }
  const std::string bytes = motion.bytes();
  Assimp::Importer importer;
  const aiScene* read = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "glb");
  ASSERT_NE(read, nullptr) << importer.GetErrorString();
  const aiAnimation& animation = *read->mAnimations[0];
  const aiNodeAnim* const* channel =
      std::find_if(animation.mChannels, animation.mChannels + animation.mNumChannels,
                   [](const aiNodeAnim* c) { return c->mNodeName == aiString("die[0]"); });
  for (unsigned k = 0; k < 4; ++k)
    EXPECT_EQ(toQuat((*channel)->mRotationKeys[k].mValue).coeffs(), turned.coeffs()) << k;
}

TEST(MotionGltf, CamerasThatMoveAreAnimatedAndTheOthersNot) {
  Scene scene = spinningScene();
  scene.cameras["chase"].motion = FollowBody{"die[2]", Vec3(1, -4, 2)};
  const Exported file(scene, 3);
  const aiAnimation& animation = *file.read->mAnimations[0];
  const auto channelOf = [&](const char* name) {
    return std::find_if(animation.mChannels, animation.mChannels + animation.mNumChannels,
                        [&](const aiNodeAnim* c) { return c->mNodeName == aiString(name); });
  };
  EXPECT_EQ(channelOf("camera main"), animation.mChannels + animation.mNumChannels);
  const aiNodeAnim* const* chase = channelOf("camera chase");
  ASSERT_NE(chase, animation.mChannels + animation.mNumChannels);
  for (unsigned k = 0; k < 3; ++k) {
    const Vec3 die = file.states[k][2].X_WB.position;
    EXPECT_LT((shownPoint(file, **chase, k, Vec3(0, 0, 0)) - upright(die + Vec3(1, -4, 2))).norm(),
              kTolerance_m);
    // It looks along its -z, at the body.
    const Vec3 ahead = shownPoint(file, **chase, k, Vec3(0, 0, -Vec3(1, -4, 2).norm()));
    EXPECT_LT((ahead - upright(die)).norm(), 10.0 * kTolerance_m);
  }
}

TEST(MotionGltf, CopiesShareTrianglesAndThoseOfOneColourTheMesh) {
  const Exported file(spinningScene(), 2);
  ASSERT_NE(file.read, nullptr) << file.importer.GetErrorString();
  EXPECT_EQ(file.read->mNumMeshes, 2u);
  EXPECT_EQ(file.node(0).mMeshes[0], file.node(2).mMeshes[0]);
  EXPECT_NE(file.node(0).mMeshes[0], file.node(1).mMeshes[0]);
  aiString name;
  file.read->mMaterials[file.read->mMeshes[file.node(1).mMeshes[0]]->mMaterialIndex]->Get(AI_MATKEY_NAME,
                                                                                          name);
  EXPECT_STREQ(name.C_Str(), "bone #0000ff");
}

TEST(MotionGltf, ASceneWhereNothingMovesHasNoAnimation) {
  Scene scene = spinningScene();
  scene.bodies[0].is_static = true;
  scene.bodies[0].angular_velocity.setZero();
  const Exported file(scene, 2);
  ASSERT_NE(file.read, nullptr) << file.importer.GetErrorString();
  EXPECT_EQ(file.read->mNumAnimations, 0u);
  EXPECT_EQ(file.read->mRootNode->mNumChildren, 5u);
}

TEST(MotionGltf, MoreMotionThanAFileHoldsIsRefusedBeforeAnythingIsDone) {
  const Scene scene = spinningScene();
  const SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const std::string message = thrownMessage<UsageError>([&] { MotionGltf(scene, made, 100'000'000); });
  EXPECT_NE(message.find("do not fit into a .glb file; accepted: "), std::string::npos) << message;
}

}  // namespace
}  // namespace carom::demos
