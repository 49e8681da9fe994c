// Bullet's step of a heap: its discrete world with default settings, one step a call, nothing deactivated
// unless the heap sleeps. Only the bullet_*.cpp of this folder name Bullet.

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "tests/bench/peers/pile_step.h"

namespace carom::bench {

std::vector<double> bulletStepTimes(const PlainPile& pile, int steps);

namespace {

btScalar narrowed(double x) {
  return static_cast<btScalar>(x);
}

std::unique_ptr<btCollisionShape> shapeOf(const PlainSolid& solid) {
  if (solid.box_size[0] > 0.0)
    return std::make_unique<btBoxShape>(btVector3(narrowed(0.5 * solid.box_size[0]),
                                                  narrowed(0.5 * solid.box_size[1]),
                                                  narrowed(0.5 * solid.box_size[2])));
  auto hull = std::make_unique<btConvexHullShape>();
  for (const auto& v : solid.hull.vertices)
    hull->addPoint(btVector3(narrowed(v[0]), narrowed(v[1]), narrowed(v[2])), false);
  hull->recalcLocalAabb();
  return hull;
}

class BulletHeap {
 public:
  explicit BulletHeap(const PlainPile& pile) {
    world_.setGravity(btVector3(0, 0, narrowed(-pile.gravity)));
    for (const PlainSolid& solid : pile.solids) shapes_.push_back(shapeOf(solid));
    for (const PlainBody& body : pile.bodies) add(pile, body);
  }
  ~BulletHeap() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  BulletHeap(const BulletHeap&) = delete;
  BulletHeap& operator=(const BulletHeap&) = delete;

  void step(double step_s) { world_.stepSimulation(narrowed(step_s), 0); }

 private:
  void add(const PlainPile& pile, const PlainBody& body) {
    const auto index = static_cast<std::size_t>(body.solid);
    btCollisionShape* shape = shapes_[index].get();
    const btScalar mass = body.is_static ? btScalar(0) : narrowed(pile.solids[index].mass);
    btVector3 inertia(0, 0, 0);
    if (!body.is_static) shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape, inertia);
    const auto& q = body.X_WB.rotation_wxyz;
    const auto& p = body.X_WB.position;
    info.m_startWorldTransform =
        btTransform(btQuaternion(narrowed(q[1]), narrowed(q[2]), narrowed(q[3]), narrowed(q[0])),
                    btVector3(narrowed(p[0]), narrowed(p[1]), narrowed(p[2])));
    info.m_friction = narrowed(std::sqrt(pile.friction));  // Bullet multiplies the two
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    const auto& v = body.velocity;
    bodies_.back()->setLinearVelocity(btVector3(narrowed(v[0]), narrowed(v[1]), narrowed(v[2])));
    if (!pile.sleeps) bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(bodies_.back().get());
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broad_phase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

std::vector<double> bulletStepTimes(const PlainPile& pile, int steps) {
  BulletHeap heap(pile);
  return settledSteps(pile, steps, [&] { heap.step(pile.step_s); });
}

}  // namespace carom::bench
