#pragma once
// Makes the record of a run while it is drawn: watches the world step by step and is told of each frame.
// Observation only: the frames and states are those of a run without it. Tested in
// tests/demos/program/cause_program_test.cpp.

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "demos/cause/motion_record.h"
#include "demos/record/recording.h"
#include "demos/scene/scene_world.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {

class MotionRecorder {
 public:
  /// Watches `made`, which must outlive this, and be watched by nobody else.
  MotionRecorder(const Scene& scene, SceneWorld& made, const renderer::Settings& settings);
  ~MotionRecorder();
  MotionRecorder(const MotionRecorder&) = delete;
  MotionRecorder& operator=(const MotionRecorder&) = delete;

  /// A fact of how frames look that is not in the settings.
  void addLook(const std::string& name, const std::string& value) { record_.look.emplace_back(name, value); }
  /// Takes what is behind the pixels of frames that are kept from the record that a run before left there, if
  /// any.
  void recall(const std::filesystem::path& folder);
  /// After every step.
  void follow(const World& world);
  /// A frame's file and what it says of itself, which tells the moment and the state.
  struct ShotFile {
    std::string name;
    renderer::PngText text;
  };
  /// Before the frame is drawn.
  void addShot(const ShotFile& file, double time_s, const FrameState& state, const renderer::Camera& camera);
  /// What is behind the pixels of the shot added last, from the record recalled; false where it does not say.
  bool recallPixels(int width, int height);
  /// What is behind the pixels of the shot added last; beyond kMostPixels in all it is left out.
  void addPixels(const renderer::SurfaceImage& surfaces, int width, int height);
  bool wantsPixels(int width, int height) const;

  /// Throws CannotWrite.
  void write(const std::filesystem::path& folder, const renderer::ContextInfo& gl);

  static constexpr std::size_t kMostPixels = std::size_t{1} << 20;

 private:
  /// Beyond this many poses every second moment is forgotten.
  static constexpr std::size_t kMostPoses = 20000;
  static constexpr std::size_t kMostStrikes = 4000;
  static constexpr std::size_t kMostPrints = 16384;

  void addMoment(const World& world);
  void addPrint(const World& world);
  std::vector<RoundedPose> posesOf(std::span<const BodyState> states) const;

  SceneWorld& made_;
  StepView view_;
  MotionRecord record_;
  std::optional<MotionRecord> former_;
  int moment_stride_ = 1;
  std::size_t pixels_ = 0;
};

/// Whether the record in a folder is of frames there, as they are, beside these.
bool recordIsOfOthers(const std::filesystem::path& folder, const std::set<std::string>& files);

}  // namespace carom::demos
