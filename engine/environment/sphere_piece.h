#pragma once
// A convex piece of the unit sphere, bounded by great circles, cut by a plane: area and first and second
// moments of what lies below, in closed form from integrals along the border. With x on the border, its
// tangent T (the piece on the left) and the outward conormal nu = T x x:
// - area: signed spherical triangles with one corner at the lowest point -n for great arcs, and sectors
//   (1 + c) dphi for arcs of the cutting circle n . x = c;
// - integral of x: half the integral of x cross dx;
// - integral of x x^T: (area I - integral of nu x^T ds) / 3, by the divergence theorem on the sphere.
// Tested in tests/engine/environment/rounded_cut_test.cpp.

#include <vector>

#include "engine/foundation/frames.h"

namespace carom {

struct SphereIntegrals {
  double area = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
};

class SpherePiece {
 public:
  /// Makes it the whole sphere again.
  void clear() { arcs_.clear(); }
  /// One side: directions x with d . x <= 0, from corner to corner (in either order); unit vectors.
  void addArc(const Vec3& d, const Vec3& corner, const Vec3& other);
  /// The only side: all directions with d . x <= 0.
  void addHemisphere(const Vec3& d);

  /// Of the directions x of the piece with n . x <= c. Any number of sides; without one, the whole sphere.
  SphereIntegrals below(const Vec3& n, double c);

 private:
  struct Arc {
    Vec3 d = Vec3::Zero();
    Vec3 from = Vec3::Zero();
    double angle = 0.0;
  };
  bool contains(const Vec3& x) const;

  std::vector<Arc> arcs_;
  std::vector<double> angles_;  ///< Between calls, so that nothing is allocated twice.
};

}  // namespace carom
