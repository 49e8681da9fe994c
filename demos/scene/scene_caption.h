#pragma once
// The caption of a scene in a frame: a function of the frame's time and the bodies' states there, so that any
// frame has the same line whoever draws it. Tested in tests/demos/scene/scene_caption_test.cpp.

#include <map>
#include <span>
#include <string>
#include <vector>

#include "demos/scene/scene_world.h"

namespace carom::demos {

class SceneCaption {
 public:
  /// `start` is the world as it is at the start and must outlive this.
  SceneCaption(const Scene& scene, const SceneWorld& start);

  bool empty() const { return text_.empty(); }
  std::string at(double time_s, std::span<const BodyState> bodies) const;

 private:
  double bodyFigure(const BodyQuantity& quantity, std::span<const BodyState> bodies) const;
  double sceneFigure(const std::string& name, double time_s, std::span<const BodyState> bodies) const;
  double kineticEnergyOf(std::size_t body, const BodyState& state) const;

  const World& world_;
  CaptionText text_;
  std::map<std::string, std::size_t> index_;  ///< Of the bodies it speaks of.
  std::vector<Pose> start_;
};

}  // namespace carom::demos
