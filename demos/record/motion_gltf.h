#pragma once
// A scene and its motion as binary glTF 2.0 (Khronos, glTF 2.0 Specification, 2021): a node a body with the
// solid's triangles, a node a camera (for a picture of 16:9 where it
// fits the scene), and one animation with a key a frame. The world's z is up; the node
// above all others turns it to glTF's y. What glTF has no word for (friction, density) is in the nodes'
// extras. Written by tinygltf, which no other file names: assimp 5.2 writes animations, but no cameras.
// Tested in tests/demos/record/motion_gltf_test.cpp.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "demos/scene/camera_path.h"
#include "demos/scene/scene.h"
#include "demos/scene/scene_world.h"

namespace carom::demos {

class MotionGltf {
 public:
  /// Both must outlive this. Throws UsageError when that many frames do not fit into a file.
  MotionGltf(const Scene& scene, const SceneWorld& world, int frames);

  /// Frames are added in order of time. Poses become single precision; rotations take the sign that is
  /// nearest to the last one's, so that programs which blend the four numbers turn the short way.
  void add(double time_s, std::span<const BodyState> states);
  /// The file; at least one frame must have been added.
  std::string bytes() const;

 private:
  struct Track {
    std::vector<float> translations;
    std::vector<float> rotations;  ///< x, y, z, w.
    void add(const Vec3& position, const Quat& rotation);
  };
  struct BodyTrack : Track {
    std::size_t body = 0;
  };
  struct CameraTrack : Track {
    std::string name;
    CameraPath path;
    bool moves = false;
    renderer::Camera first;  ///< In the first frame.
  };

  const Scene& scene_;
  const SceneWorld& world_;
  std::vector<Pose> first_;  ///< Of every body, in the first frame.
  std::vector<float> times_s_;
  std::vector<BodyTrack> tracks_;  ///< Of the bodies that are not static.
  std::vector<CameraTrack> cameras_;
};

}  // namespace carom::demos
