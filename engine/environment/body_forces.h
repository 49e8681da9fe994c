#pragma once
// Everything the environment does to one body in one pose (paper §3 names it as what is missing): weight,
// buoyancy at the centroid of what is under water, the drag of air on the dry and of fluids on the wetted
// surface, and the water that moves along. In the body's frame, about the centre of mass. Tested in
// tests/engine/environment/body_forces_test.cpp and tests/physics/.

#include <optional>
#include <vector>

#include "engine/environment/air.h"
#include "engine/environment/applied_load.h"
#include "engine/environment/drag.h"
#include "engine/environment/fluid.h"
#include "engine/environment/rounded_cut.h"
#include "engine/environment/solid_surface.h"
#include "engine/motion/axis_locks.h"
#include "engine/motion/rigid_body.h"

namespace carom {

struct Environment {
  Vec3 gravity = Vec3::Zero();
  Air air;
  std::vector<Fluid> fluids;

  /// Gravity is all there is.
  bool isVacuum() const { return !(air.density_kgpm3 > 0.0) && fluids.empty(); }
};

/// The body that the environment acts on.
struct EnvironmentBody {
  const SolidSurface* surface = nullptr;
  const Inertia* inertia = nullptr;
  std::optional<double> drag_coefficient;  ///< In place of the standard ones.
  const AppliedLoad* load = nullptr;       ///< What else acts on it.
  const AxisLocks* locks = nullptr;        ///< What it cannot do.
};

struct BodyForces {
  Vec6 load = Vec6::Zero();        ///< N, N m: what does not depend on the velocity.
  Mat6 added_mass = Mat6::Zero();  ///< kg, of water that moves along.
  Mat6 quadratic = Mat6::Zero();   ///< Drag is -(S + B) V + stream.
  Mat6 linear = Mat6::Zero();
  Vec6 quadratic_stream = Vec6::Zero();  ///< S W, B W summed over the streams.
  Vec6 linear_stream = Vec6::Zero();
  double submerged_m3 = 0.0;

  /// The whole wrench at the velocity V for which it was computed.
  Vec6 total(const Vec6& v) const {
    return load + quadratic_stream + linear_stream - quadratic * v - linear * v;
  }
};

struct ForceScratch {
  RoundedScratch cut;
  FacetList wet, dry;
};

/// `velocity` (linear, angular) in the body's frame, `t_s` for waves.
BodyForces bodyForces(const Environment& environment, const EnvironmentBody& body, const Pose& X_WB,
                      const Vec6& velocity, double t_s, ForceScratch& scratch);

/// What of the solid is under the fluid's surface and within its sides, in the body's frame. Exact for
/// polyhedra, and for rounded parts cut by the surface alone; where such a part crosses a side of a box as
/// well, the shares that the planes cut off are multiplied. Under waves the surface is the plane that touches
/// it over or under the centre of mass.
VolumeMoments submergedPart(const SolidSurface& surface, const Fluid& fluid, double gravity_mps2,
                            const Pose& X_WB, double t_s, ForceScratch& scratch);

/// Whether the body can touch the fluid while its centre of mass stays within `reach_m` of where it is.
bool reaches(const Fluid& fluid, const Vec3& center_W, double reach_m);

/// Energy that the displaced fluid has gained, J, in still water: -rho V g . (c - the surface). Waves count
/// as they stand at `t_s`.
double buoyancyPotential(const Environment& environment, const SolidSurface& surface, const Pose& X_WB,
                         double t_s, ForceScratch& scratch);

}  // namespace carom
