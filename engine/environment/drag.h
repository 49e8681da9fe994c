#pragma once
// Drag as matrices: with g(r) = (n, r x n) the pressure on a face's windward side is a quadratic form of the
// body's velocity V = (v, omega) relative to the stream, so the drag is -(S(U) + B) U, U = V - W, with S of
// first degree in U and both S and B symmetric and not negative. Every point of a face has its own speed v +
// omega x r: turning is braked, and what falls askew is turned. All in the body's frame, about the centre of
// mass. Source: pressure 1/2 rho C_d u_n^2 on the windward side (Newton's impact law); balls and capsules by
// standard coefficients (Hoerner, Fluid-Dynamic Drag, 1965). Tested in
// tests/engine/environment/drag_test.cpp.

#include <algorithm>

#include "engine/environment/plane_cut.h"

namespace carom {

using Vec6 = Eigen::Matrix<double, 6, 1>;  ///< (linear, angular) or (force, torque).
using Mat6 = Eigen::Matrix<double, 6, 6>;

// Drag coefficients where a body has none of its own: a cube face on, a ball, a cylinder across the stream.
inline constexpr double kFaceDrag = 1.05;
inline constexpr double kBallDrag = 0.47;
inline constexpr double kCylinderDrag = 1.1;

/// A fluid takes hold of a point by how deep it lies under the surface: not at all on it, wholly from a small
/// depth on, so that a face that enters flat gets no blow. Zero `inverse_depth`: wholly everywhere.
struct Hold {
  Plane surface;
  double inverse_depth = 0.0;  ///< 1/m.

  double at(const Vec3& p_B) const {
    return inverse_depth > 0.0 ? std::clamp(-surface.signedDistance(p_B) * inverse_depth, 0.0, 1.0) : 1.0;
  }
};

/// What drags on a body in one stream: `velocity` is U.
struct StreamDrag {
  Vec6 velocity = Vec6::Zero();
  Mat6 quadratic = Mat6::Zero();  ///< S.
  Mat6 linear = Mat6::Zero();     ///< B.
};

/// The pressure on the windward part of a flat facet; `pressure` is 1/2 rho C_d, kg/m^3. In a stream that
/// comes askew it is higher towards the leading edge, in proportion to the cosine of the angle of attack,
/// with the same sum: what Joessel (1870) found of rudders, that the centre of pressure moves there, by a
/// sixth of the chord at most here. This is what makes plates flutter and cubes tumble. Exact integrals over
/// that part.
void addPressure(std::span<const Vec3> facet, const Vec3& normal, double pressure, const Hold& hold,
                 CutScratch& scratch, StreamDrag& drag);
/// Drag along a flat facet, 1/2 rho C_f |u_t| u_t; `friction` is 1/2 rho C_f.
void addSkinFriction(std::span<const Vec3> facet, const Vec3& normal, double friction, StreamDrag& drag);
/// A force of -c u at every point of a facet, c in kg/(m^2 s).
void addLinear(std::span<const Vec3> facet, const Vec3& normal, double c, const Hold& hold,
               CutScratch& scratch, StreamDrag& drag);

/// A force -kappa |P u| P u at one point, P the identity, or what stands across `axis` (unit, not zero).
void addPointDrag(const Vec3& p_B, double kappa, const Vec3& axis, StreamDrag& drag);
/// A force of -c u at one point, and a torque -t omega.
void addPointLinear(const Vec3& p_B, double c, double t, StreamDrag& drag);

}  // namespace carom
