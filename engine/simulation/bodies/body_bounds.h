#pragma once
// Bounds of bodies and of their shapes, in the axes of the world. They are made anew for a body only when
// turning could have moved a point of it by more than the margin that it is paired with; until then they go
// with the body, widened by what it can have turned. Internal to the simulation floor. Tested through
// tests/engine/simulation/contacts/pair_table_test.cpp.

#include <span>
#include <vector>

#include "engine/broad_phase/bounds_tree.h"
#include "engine/contact/separating_axis.h"
#include "engine/foundation/crew.h"
#include "engine/foundation/tolerances.h"
#include "engine/simulation/bodies/body.h"

namespace carom {

/// Room for the collision window, and for what contacts may do to the velocity within the step. The shapes of
/// a body have one width.
inline double pairingMargin(const Shape& shape) {
  return 2.0 * tolerance::kManifoldHeight * std::min(shape.width_m, tolerance::kWindowLargestScale);
}

/// Everything that bounds can touch along their body's path until `end_s`: moved along the parabola, and
/// grown by what turning can do to what reaches so far.
Bounds sweptBounds(Bounds bounds, double reach_m, const Trajectory& path, double end_s);

class BodyBounds {
 public:
  bool knows(std::span<const Shape> shapes) const { return of_shape_.size() == shapes.size(); }
  void begin(std::size_t bodies, std::span<const Shape> shapes);
  /// Anew where bodies, ascending, have turned too far where their paths begin. No body twice.
  void follow(const std::vector<Body>& bodies, const std::vector<Shape>& shapes, std::span<const int> some,
              Crew& crew);

  int firstShape(int body) const { return first_shape_[static_cast<std::size_t>(body)]; }
  int endShape(int body) const { return first_shape_[static_cast<std::size_t>(body) + 1]; }
  int shapesOf(int body) const { return endShape(body) - firstShape(body); }
  /// The largest distance of a core of the body from its centre of mass, m.
  double reach(int body) const { return reach_m_[static_cast<std::size_t>(body)]; }
  const CoreBall& ball(int shape) const { return balls_[static_cast<std::size_t>(shape)]; }
  Bounds ofBody(int body, const Pose& X_WB) const;
  Bounds ofShape(int shape, const std::vector<Shape>& shapes, const Pose& X_WB) const;
  /// The shapes of a body that could reach into these, ascending. Cost about O(log shapes + found).
  void findReaching(int body, const Pose& X_WB, const Bounds& bounds_W, std::vector<int>& found) const;

 private:
  void join(int body);

  std::vector<int> first_shape_;             ///< Of each body, and the end.
  std::vector<double> reach_m_;              ///< Of the bodies.
  std::vector<Quat> R_WB_;                   ///< The orientations that the bounds were made for.
  std::vector<Bounds> of_shape_;             ///< From the body's centre of mass.
  std::vector<Bounds> of_body_;              ///< Likewise.
  std::vector<CoreBall> balls_;              ///< Of the shapes.
  std::vector<BoundsTree> trees_;            ///< Of bodies of several shapes: these, in its own axes.
  std::vector<int> turned_, turned_shapes_;  ///< Scratch.
};

}  // namespace carom
