#pragma once
// Balls, capsules and rounded polyhedra cut by one plane. The border of such a solid is made of flat faces,
// pieces of cylinders along edges and pieces of spheres at vertices; the same surface integrals as in
// plane_cut.h are taken over what of each lies below the plane: in closed form on faces and spheres, on
// cylinders by Gauss's rule between the angles where the cut changes its form, where the integrand is a
// trigonometric polynomial and the rule exact to rounding. Tested in
// tests/engine/environment/rounded_cut_test.cpp.

#include "engine/environment/plane_cut.h"
#include "engine/environment/sphere_piece.h"
#include "engine/solid/solid.h"

namespace carom {

struct RoundedScratch {
  CutScratch cut;
  SpherePiece piece;
};

/// What of a ball lies where n . p <= offset: a cap, in closed form.
VolumeMoments cutBall(const Vec3& center, double radius_m, const Plane& plane);

/// The same of a convex part with a rounding radius. The plane must cut the part. Cost: linear in the
/// features; about as much as 50 sines for every edge.
VolumeMoments cutRounded(const ConvexPart& part, const Plane& plane, RoundedScratch& scratch);

}  // namespace carom
