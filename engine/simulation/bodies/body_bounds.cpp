#include "engine/simulation/bodies/body_bounds.h"

#include <algorithm>
#include <numeric>

#include "engine/foundation/index.h"

namespace carom {
namespace {

// Of more vertices, the farthest are walked to in less time than all are looked at.
constexpr int kScannedVertices = 16;

// Of a core in the axes of the world, from its origin.
Bounds turnedBounds(const ConvexPolyhedron& core, const Mat3& to_body) {
  Bounds bounds;
  int v = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vec3 direction = to_body.col(axis);
    double& low = bounds.low[axis];
    double& high = bounds.high[axis];
    if (core.vertexCount() <= kScannedVertices) {
      low = high = dot(direction, core.vertex(0));
      for (int i = 1; i < core.vertexCount(); ++i) {
        const double along = dot(direction, core.vertex(i));
        low = std::min(low, along);
        high = std::max(high, along);
      }
    } else {
      v = core.support(direction, v);
      high = dot(direction, core.vertex(v));
      v = core.support(-direction, v);
      low = dot(direction, core.vertex(v));
    }
  }
  return bounds;
}

// Of a part from its body's centre of mass, in the axes of the world.
Bounds turnedBounds(const ConvexPart& part, const Quat& R_WB) {
  return widened(turnedBounds(part.core, R_WB.conjugate().toRotationMatrix()), part.radius_m);
}

CoreBall ballAbout(const Vec3& middle_B, const ConvexPolyhedron& core) {
  return {middle_B, middle_B.norm(), core.radiusAbout(middle_B)};
}

Bounds movedTo(Bounds bounds, const Vec3& position) {
  bounds.low += position;
  bounds.high += position;
  return bounds;
}

}  // namespace

// The bounds at the start moved along the parabola and grown by what rotation can do.
Bounds sweptBounds(Bounds bounds, double reach_m, const Trajectory& path, double end_s) {
  const double dt = end_s - path.start_s;
  const Vec3 travel = path.positionAt(end_s) - path.X_WB.position;
  const double sag = 0.125 * path.acceleration.norm() * dt * dt;
  const double turn = std::min(path.fastestSpin() * dt, 2.0) * reach_m;
  const double margin = turn + sag;
  bounds.low = bounds.low + travel.cwiseMin(0.0) - Vec3::Constant(margin);
  bounds.high = bounds.high + travel.cwiseMax(0.0) + Vec3::Constant(margin);
  return bounds;
}

void BodyBounds::begin(std::size_t bodies, std::span<const Shape> shapes) {
  first_shape_.assign(bodies + 1, 0);
  reach_m_.assign(bodies, 0.0);
  R_WB_.assign(bodies, Quat::Identity());
  of_body_.assign(bodies, {});
  of_shape_.clear();
  balls_.clear();
  for (const Shape& shape : shapes) {
    ++first_shape_[at(shape.body) + 1];
    reach_m_[at(shape.body)] = std::max(reach_m_[at(shape.body)], shape.reach_m);
    const Bounds bounds = turnedBounds(*shape.part, Quat::Identity());
    of_shape_.push_back(bounds);
    balls_.push_back(ballAbout(0.5 * (bounds.low + bounds.high), shape.part->core));
  }
  std::partial_sum(first_shape_.begin(), first_shape_.end(), first_shape_.begin());
  trees_.assign(bodies, {});
  for (int body = 0; body < static_cast<int>(bodies); ++body) {
    join(body);
    if (shapesOf(body) > 1)
      trees_[at(body)].build(std::span(of_shape_).subspan(at(firstShape(body)), at(shapesOf(body))));
  }
}

void BodyBounds::join(int body) {
  if (shapesOf(body) == 0) return;
  Bounds& whole = of_body_[at(body)];
  whole = of_shape_[at(firstShape(body))];
  for (int i = firstShape(body) + 1; i < endShape(body); ++i) whole = together(whole, of_shape_[at(i)]);
}

void BodyBounds::follow(const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                        std::span<const int> some, Crew& crew) {
  turned_.clear();
  turned_shapes_.clear();
  for (const int body : some) {
    if (shapesOf(body) == 0) continue;
    const Quat& R_WB = bodies[at(body)].path.X_WB.rotation;
    if (!(reach(body) * mostTurned(R_WB_[at(body)], R_WB) > pairingMargin(shapes[at(firstShape(body))])))
      continue;
    R_WB_[at(body)] = R_WB;
    turned_.push_back(body);
    for (int i = firstShape(body); i < endShape(body); ++i) turned_shapes_.push_back(i);
  }
  crew.runStretches(turned_shapes_.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Shape& shape = shapes[at(turned_shapes_[k])];
      of_shape_[at(turned_shapes_[k])] = turnedBounds(*shape.part, R_WB_[at(shape.body)]);
    }
  });
  for (const int body : turned_) join(body);
}

void BodyBounds::findReaching(int body, const Pose& X_WB, const Bounds& bounds_W,
                              std::vector<int>& found) const {
  found.clear();
  if (shapesOf(body) == 1) {
    found.push_back(firstShape(body));
    return;
  }
  const Mat3 R_BW = X_WB.rotation.conjugate().toRotationMatrix();
  const Vec3 middle = R_BW * (0.5 * (bounds_W.low + bounds_W.high) - X_WB.position);
  const Vec3 half = R_BW.cwiseAbs() * (0.5 * (bounds_W.high - bounds_W.low));
  trees_[at(body)].find({middle - half, middle + half}, found);
  for (int& shape : found) shape += firstShape(body);
  std::sort(found.begin(), found.end());
}

Bounds BodyBounds::ofBody(int body, const Pose& X_WB) const {
  const double turned = reach(body) * mostTurned(R_WB_[at(body)], X_WB.rotation);
  return movedTo(widened(of_body_[at(body)], turned), X_WB.position);
}

Bounds BodyBounds::ofShape(int shape, const std::vector<Shape>& shapes, const Pose& X_WB) const {
  const Shape& s = shapes[at(shape)];
  const double turned = s.reach_m * mostTurned(R_WB_[at(s.body)], X_WB.rotation);
  return movedTo(widened(of_shape_[at(shape)], turned), X_WB.position);
}

}  // namespace carom
