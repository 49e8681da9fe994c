// Bullet's discrete world with default settings as a Simulation (tests/physics/experiments/experiment.h), one
// step a call. Friction and restitution are roots, since Bullet multiplies those of a pair. The files that
// name Bullet are the bullet_*.cpp of this folder.

#include <btBulletDynamicsCommon.h>

#include "tests/bench/physics/physics.h"

namespace carom::bench {
namespace {

using physics::Experiment;
using physics::ExperimentBody;
using physics::ShapeKind;

btScalar narrowed(double x) {
  return static_cast<btScalar>(x);
}
btVector3 narrowed(const Vec3& v) {
  return {narrowed(v.x()), narrowed(v.y()), narrowed(v.z())};
}
Vec3 widened(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

std::unique_ptr<btCollisionShape> shapeOf(const physics::Shape& shape) {
  if (shape.kind == ShapeKind::kBall) return std::make_unique<btSphereShape>(narrowed(shape.radius_m));
  if (shape.kind == ShapeKind::kBox) return std::make_unique<btBoxShape>(narrowed(Vec3(0.5 * shape.size_m)));
  if (shape.kind == ShapeKind::kCapsule)
    return std::make_unique<btCapsuleShapeZ>(narrowed(shape.radius_m), narrowed(shape.size_m.z()));
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& v : shape.solid.parts()[0].core.vertices()) hull->addPoint(narrowed(v), false);
  hull->recalcLocalAabb();
  return hull;
}

class BulletSimulation final : public physics::Simulation {
 public:
  explicit BulletSimulation(const Experiment& experiment) : step_s_(experiment.step_s) {
    world_.setGravity(narrowed(Vec3(0, 0, -experiment.gravity)));
    for (const ExperimentBody& body : experiment.bodies) add(experiment, body);
  }
  ~BulletSimulation() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  void step() override { world_.stepSimulation(narrowed(step_s_), 0); }

  physics::Motion motion(int body) const override {
    const btRigidBody& b = at(body);
    const btQuaternion q = b.getWorldTransform().getRotation();
    const Quat rotation(static_cast<double>(q.w()), static_cast<double>(q.x()), static_cast<double>(q.y()),
                        static_cast<double>(q.z()));
    return {{rotation.normalized(), widened(b.getWorldTransform().getOrigin())},
            widened(b.getLinearVelocity()),
            widened(b.getAngularVelocity())};
  }
  bool atRest(int body) const override { return !at(body).isActive(); }

 private:
  const btRigidBody& at(int body) const { return *bodies_[static_cast<std::size_t>(body)]; }

  void add(const Experiment& experiment, const ExperimentBody& body) {
    shapes_.push_back(shapeOf(body.shape));
    const btScalar mass = body.is_static ? btScalar(0) : narrowed(body.mass_kg);
    const btVector3 inertia = body.is_static ? btVector3(0, 0, 0) : narrowed(Vec3(body.inertia().diagonal()));
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(), inertia);
    const Quat& q = body.X_WB.rotation;
    info.m_startWorldTransform =
        btTransform(btQuaternion(narrowed(q.x()), narrowed(q.y()), narrowed(q.z()), narrowed(q.w())),
                    narrowed(body.X_WB.position));
    info.m_friction = narrowed(std::sqrt(body.friction));
    info.m_restitution = narrowed(std::sqrt(body.restitution));
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody& made = *bodies_.back();
    made.setLinearVelocity(narrowed(body.velocity));
    made.setAngularVelocity(narrowed(body.spin));
    if (!experiment.resting) made.setActivationState(DISABLE_DEACTIVATION);
    if (experiment.continuous_collision &&
        !body.is_static) {  // as its manual advises: half the smallest half size
      const Vec3 half = 0.5 * body.shape.size_m;
      made.setCcdMotionThreshold(narrowed(half.minCoeff()));
      made.setCcdSweptSphereRadius(narrowed(0.5 * half.minCoeff()));
    }
    world_.addRigidBody(&made);
  }

  double step_s_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broad_phase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

std::unique_ptr<physics::Simulation> startBullet(const Experiment& experiment) {
  return std::make_unique<BulletSimulation>(experiment);
}

}  // namespace carom::bench
