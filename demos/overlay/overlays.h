#pragma once
// The overlays of a run: follows the run frame by frame, keeps what they need to know of earlier ones, and
// draws those chosen over each finished picture. A frame's overlays depend on the run up to it, never on
// which frames are drawn. Tested in tests/demos/overlay/overlays_test.cpp and
// tests/demos/program/overlay_program_test.cpp.

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "demos/motion/frame_clock.h"
#include "demos/motion/frame_source.h"
#include "demos/motion/phase_stopwatch.h"
#include "demos/overlay/overlay_choice.h"
#include "demos/overlay/overlay_frame.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {

/// How long trails are, seconds.
inline constexpr double kTrailTime_s = 2.0;

class Overlays {
 public:
  struct Choice {
    OverlayChoice shown;
    std::string focus;  ///< Names of bodies, or empty.
    bool recorded = false;
  };
  /// Watches the world unless it only lends its bodies to a recording. `scene` and `clock` must outlive this.
  /// Throws UsageError when the focus names no body, and for overlays that a recording cannot show.
  Overlays(const Choice& choice, SceneWorld& scene, const FrameClock& clock);
  ~Overlays();
  Overlays(const Overlays&) = delete;
  Overlays& operator=(const Overlays&) = delete;

  bool any() const { return choice_.shown.any(); }
  /// What they are, for the frame's identity; empty: none.
  std::string identity() const;
  /// Who is to be told of the steps' phases; null unless timings are shown.
  PhaseClock* phases() { return watch_.get(); }

  /// The state at a frame of `source`, having followed all frames up to it.
  FrameState advance(FrameSource& source, int frame);
  /// Bodies in the colours of their modes, if that is chosen.
  void recolor(std::span<const BodyState> bodies, std::vector<renderer::Instance>& instances) const;
  /// Draws the frame's picture with its overlays; `state` is what `advance` returned.
  renderer::Image draw(renderer::FrameRenderer& pictures, const FrameState& state, int frame,
                       const renderer::Camera& camera, std::span<const renderer::WaterVolume> water = {});
  /// Draws the overlays alone over `image`.
  renderer::Image paint(const renderer::Image& image, const renderer::DepthImage& depth,
                        const OverlayFrame& frame, const renderer::Camera& camera) const;
  /// All that is known of the frame last advanced to.
  OverlayFrame frameOf(const FrameState& state, int frame) const;

 private:
  void follow(const FrameState& state, int frame);
  void beginTiming(int frame);
  FrameCost endTiming();

  Choice choice_;
  SceneWorld& scene_;
  const FrameClock& clock_;
  BodyFocus focus_;
  StepView step_;
  std::unique_ptr<PhaseStopwatch> watch_;
  bool timing_ = false;  ///< A frame has begun on it that has not been drawn.
  std::vector<ContactView> collisions_;
  std::deque<std::vector<Vec3>> positions_;  ///< Of all bodies at the last frames.
  int followed_ = -1;
};

}  // namespace carom::demos
