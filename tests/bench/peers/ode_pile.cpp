// ODE's step of a heap: hash space, up to eight contacts a pair, quick step with its default iterations,
// nothing disabled. Only the ode_*.cpp of this folder name ODE.

#include <ode/ode.h>

#include <cmath>
#include <deque>

#include "tests/bench/peers/pile_step.h"

namespace carom::bench {

std::vector<double> odeStepTimes(const PlainPile& pile, int steps);

namespace {

constexpr int kMostContacts = 8;

dReal narrowed(double x) {
  return static_cast<dReal>(x);
}

// The arrays that a convex geom refers to.
struct ConvexArrays {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;

  explicit ConvexArrays(const Hull& hull) {
    for (const auto& v : hull.vertices)
      for (double x : v) points.push_back(narrowed(x));
    for (const std::vector<int>& loop : hull.faces) {
      polygons.push_back(static_cast<unsigned>(loop.size()));
      for (int v : loop) polygons.push_back(static_cast<unsigned>(v));
      addPlane(hull, loop);
    }
  }

 private:
  void addPlane(const Hull& hull, const std::vector<int>& loop) {
    const auto corner = [&](std::size_t i) { return hull.vertices[static_cast<std::size_t>(loop[i])]; };
    const auto o = corner(0), p = corner(1), q = corner(2);
    std::array<double, 3> n{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t y = (k + 1) % 3, z = (k + 2) % 3;
      n[k] = (p[y] - o[y]) * (q[z] - o[z]) - (p[z] - o[z]) * (q[y] - o[y]);
    }
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double offset = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      offset += n[k] / length * o[k];
      planes.push_back(narrowed(n[k] / length));
    }
    planes.push_back(narrowed(offset));
  }
};

class OdeHeap {
 public:
  explicit OdeHeap(const PlainPile& pile) : friction_(narrowed(pile.friction)) {
    dInitODE2(0);
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, 0, 0, narrowed(-pile.gravity));
    for (const PlainSolid& solid : pile.solids) arrays_.emplace_back(solid.hull);
    for (const PlainBody& body : pile.bodies) add(pile, body);
  }
  ~OdeHeap() {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
    dCloseODE();
  }
  OdeHeap(const OdeHeap&) = delete;
  OdeHeap& operator=(const OdeHeap&) = delete;

  void step(double step_s) {
    dSpaceCollide(space_, this, &OdeHeap::near);
    dWorldQuickStep(world_, narrowed(step_s));
    dJointGroupEmpty(contacts_);
  }

 private:
  dGeomID geomOf(const PlainSolid& solid, ConvexArrays& arrays) {
    if (solid.box_size[0] > 0.0)
      return dCreateBox(space_, narrowed(solid.box_size[0]), narrowed(solid.box_size[1]),
                        narrowed(solid.box_size[2]));
    return dCreateConvex(space_, arrays.planes.data(), static_cast<unsigned>(arrays.planes.size() / 4),
                         arrays.points.data(), static_cast<unsigned>(arrays.points.size() / 3),
                         arrays.polygons.data());
  }

  void add(const PlainPile& pile, const PlainBody& body) {
    const auto index = static_cast<std::size_t>(body.solid);
    const PlainSolid& solid = pile.solids[index];
    const dGeomID geom = geomOf(solid, arrays_[index]);
    if (!body.is_static) {
      const dBodyID id = dBodyCreate(world_);
      dMass mass;
      const auto& I = solid.inertia;
      dMassSetParameters(&mass, narrowed(solid.mass), 0, 0, 0, narrowed(I[0]), narrowed(I[1]), narrowed(I[2]),
                         narrowed(I[3]), narrowed(I[4]), narrowed(I[5]));
      dBodySetMass(id, &mass);
      dGeomSetBody(geom, id);
    }
    dQuaternion q;
    for (std::size_t i = 0; i < 4; ++i) q[i] = narrowed(body.X_WB.rotation_wxyz[i]);
    dNormalize4(q);
    dGeomSetQuaternion(geom, q);
    const auto& p = body.X_WB.position;
    dGeomSetPosition(geom, narrowed(p[0]), narrowed(p[1]), narrowed(p[2]));
  }

  static void near(void* self, dGeomID a, dGeomID b) {
    auto& heap = *static_cast<OdeHeap*>(self);
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (body_a == nullptr && body_b == nullptr) return;
    dContact contacts[kMostContacts] = {};
    const int n = dCollide(a, b, kMostContacts, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < n; ++i) {
      contacts[i].surface.mode = dContactApprox1;
      contacts[i].surface.mu = heap.friction_;
      dJointAttach(dJointCreateContact(heap.world_, heap.contacts_, &contacts[i]), body_a, body_b);
    }
  }

  dReal friction_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::deque<ConvexArrays> arrays_;
};

}  // namespace

std::vector<double> odeStepTimes(const PlainPile& pile, int steps) {
  OdeHeap heap(pile);
  return settledSteps(pile, steps, [&] { heap.step(pile.step_s); });
}

}  // namespace carom::bench
