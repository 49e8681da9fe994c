// ODE's world as a Simulation (tests/physics/experiments/experiment.h): hash space, up to eight contacts a
// pair, quick step, default settings, friction pyramids as its own samples have them. The files that name ODE
// are the ode_*.cpp of this folder.

#include <ode/ode.h>

#include <cmath>
#include <deque>

#include "tests/bench/physics/physics.h"

namespace carom::bench {
namespace {

using physics::Experiment;
using physics::ExperimentBody;
using physics::ShapeKind;

constexpr int kMostContacts = 8;

dReal narrowed(double x) {
  return static_cast<dReal>(x);
}
Vec3 widened(const dReal* v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// The arrays that a convex geom refers to.
struct ConvexArrays {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;

  explicit ConvexArrays(const ConvexPolyhedron& hull) {
    for (const Vec3& v : hull.vertices())
      for (double x : v) points.push_back(narrowed(x));
    for (int f = 0; f < hull.faceCount(); ++f) {
      for (double x : hull.plane(f).normal) planes.push_back(narrowed(x));
      planes.push_back(narrowed(hull.plane(f).offset));
      polygons.push_back(static_cast<unsigned>(hull.faceVertices(f).size()));
      for (int v : hull.faceVertices(f)) polygons.push_back(static_cast<unsigned>(v));
    }
  }
};

// Its global state, for the whole program.
struct OdeLibrary {
  OdeLibrary() { dInitODE2(0); }
  ~OdeLibrary() { dCloseODE(); }
  OdeLibrary(const OdeLibrary&) = delete;
  OdeLibrary& operator=(const OdeLibrary&) = delete;
};

class OdeSimulation final : public physics::Simulation {
 public:
  explicit OdeSimulation(const Experiment& experiment) : step_s_(experiment.step_s) {
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, 0, 0, narrowed(-experiment.gravity));
    dWorldSetAutoDisableFlag(world_, experiment.resting);
    bodies_ = experiment.bodies;
    for (std::size_t i = 0; i < bodies_.size(); ++i) add(bodies_[i], i);
  }
  ~OdeSimulation() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  void step() override {
    dSpaceCollide(space_, this, &OdeSimulation::near);
    dWorldQuickStep(world_, narrowed(step_s_));
    dJointGroupEmpty(contacts_);
  }

  physics::Motion motion(int body) const override {
    const dBodyID id = ids_[static_cast<std::size_t>(body)];
    if (id == nullptr) return {bodies_[static_cast<std::size_t>(body)].X_WB, Vec3::Zero(), Vec3::Zero()};
    const dReal* q = dBodyGetQuaternion(id);
    const Quat rotation(static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2]),
                        static_cast<double>(q[3]));
    return {{rotation.normalized(), widened(dBodyGetPosition(id))},
            widened(dBodyGetLinearVel(id)),
            widened(dBodyGetAngularVel(id))};
  }
  bool atRest(int body) const override {
    const dBodyID id = ids_[static_cast<std::size_t>(body)];
    return id != nullptr && dBodyIsEnabled(id) == 0;
  }

 private:
  dGeomID geomOf(const physics::Shape& shape) {
    if (shape.kind == ShapeKind::kBall) return dCreateSphere(space_, narrowed(shape.radius_m));
    if (shape.kind == ShapeKind::kBox)
      return dCreateBox(space_, narrowed(shape.size_m.x()), narrowed(shape.size_m.y()),
                        narrowed(shape.size_m.z()));
    if (shape.kind == ShapeKind::kCapsule)
      return dCreateCapsule(space_, narrowed(shape.radius_m), narrowed(shape.size_m.z()));
    const ConvexArrays& a = arrays_.emplace_back(shape.solid.parts()[0].core);
    return dCreateConvex(space_, a.planes.data(), static_cast<unsigned>(a.planes.size() / 4), a.points.data(),
                         static_cast<unsigned>(a.points.size() / 3), a.polygons.data());
  }

  void add(const ExperimentBody& body, std::size_t index) {
    const dGeomID geom = geomOf(body.shape);
    dGeomSetData(geom, &bodies_[index]);
    dBodyID id = nullptr;
    if (!body.is_static) {
      id = dBodyCreate(world_);
      dMass mass;
      const Mat3 I = body.inertia();
      dMassSetParameters(&mass, narrowed(body.mass_kg), 0, 0, 0, narrowed(I(0, 0)), narrowed(I(1, 1)),
                         narrowed(I(2, 2)), narrowed(I(0, 1)), narrowed(I(0, 2)), narrowed(I(1, 2)));
      dBodySetMass(id, &mass);
      dGeomSetBody(geom, id);
      dBodySetLinearVel(id, narrowed(body.velocity.x()), narrowed(body.velocity.y()),
                        narrowed(body.velocity.z()));
      dBodySetAngularVel(id, narrowed(body.spin.x()), narrowed(body.spin.y()), narrowed(body.spin.z()));
    }
    ids_.push_back(id);
    const Quat& r = body.X_WB.rotation;
    dQuaternion q = {narrowed(r.w()), narrowed(r.x()), narrowed(r.y()), narrowed(r.z())};
    dNormalize4(q);
    dGeomSetQuaternion(geom, q);
    const Vec3& p = body.X_WB.position;
    dGeomSetPosition(geom, narrowed(p.x()), narrowed(p.y()), narrowed(p.z()));
  }

  static void near(void* self, dGeomID a, dGeomID b) {
    auto& simulation = *static_cast<OdeSimulation*>(self);
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (body_a == nullptr && body_b == nullptr) return;
    const auto& one = *static_cast<const ExperimentBody*>(dGeomGetData(a));
    const auto& other = *static_cast<const ExperimentBody*>(dGeomGetData(b));
    dContact contacts[kMostContacts] = {};
    const int n = dCollide(a, b, kMostContacts, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < n; ++i) {
      contacts[i].surface.mode = dContactApprox1 | dContactBounce;
      contacts[i].surface.mu = narrowed(std::sqrt(one.friction * other.friction));
      contacts[i].surface.bounce = narrowed(std::max(one.restitution, other.restitution));
      dJointAttach(dJointCreateContact(simulation.world_, simulation.contacts_, &contacts[i]), body_a,
                   body_b);
    }
  }

  double step_s_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::vector<ExperimentBody> bodies_;
  std::vector<dBodyID> ids_;
  std::deque<ConvexArrays> arrays_;
};

}  // namespace

std::unique_ptr<physics::Simulation> startOde(const Experiment& experiment) {
  static const OdeLibrary library;
  dRandSetSeed(0);  // its quick step shuffles: rows do not hang on those before them
  return std::make_unique<OdeSimulation>(experiment);
}

}  // namespace carom::bench
