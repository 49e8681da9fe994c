#pragma once
// Figure 8 of the paper: multi-point collision. A slab tilted a little lies over another; its lower face is
// clipped against the V-region of the face below and the plane parallel to that at distance k. Tested in
// tests/demos/figure/figures_test.cpp.

#include "demos/figure/figure_plot.h"
#include "engine/contact/contact_manifold.h"
#include "engine/contact/contact_polygon.h"

namespace carom::demos {

struct ManifoldFigure {
  Solid below = Solid::box({1.5, 1.2, 0.3});
  Solid above = Solid::box({1.3, 0.62, 0.3});
  Pose X_WBelow;
  Pose X_WAbove;
  ClosestFeatures closest;
  CollisionWindow window;
  ContactPolygon polygon;
  ContactManifold manifold;
  renderer::Camera camera;

  /// The side view: metres along the upper slab's length, millimetres above the face below.
  Plot side(const PageSize& size) const;
  /// A point in that view.
  Vec2 inSide(const Vec3& p_W) const;
};
ManifoldFigure manifoldFigure(const PageSize& size);
renderer::Image drawManifoldFigure(const ManifoldFigure& figure, const PageSize& size);

}  // namespace carom::demos
