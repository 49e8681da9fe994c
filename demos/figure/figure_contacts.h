#pragma once
// Figures 2 to 5 of the paper: the four states of contact and their conversion to a point and a normal, each
// from a run of the shipped scene of that contact, shortly before it. Tested in
// tests/demos/figure/figures_test.cpp.

#include <string>

#include "demos/figure/figure_page.h"
#include "demos/scene/scene_world.h"
#include "engine/contact/contact_state.h"

namespace carom::demos {

struct ContactFigure {
  int number = 2;
  std::string scene_name;
  SceneWorld scene;  ///< At the instant shown.
  const ConvexPart* part_a = nullptr;
  const ConvexPart* part_b = nullptr;
  Pose X_WA;
  Pose X_WB;
  ClosestFeatures closest;
  ContactPoint contact;
  renderer::Camera camera;
};
/// `number`: 2 (vertex-face) to 5 (edge-edge).
ContactFigure contactFigure(int number, const PageSize& size);
/// How long the normal is drawn, metres.
inline constexpr double kFigureNormal_m = 0.42;
renderer::Image drawContactFigure(const ContactFigure& figure, const PageSize& size);

}  // namespace carom::demos
