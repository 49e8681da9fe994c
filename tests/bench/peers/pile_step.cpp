#include "tests/bench/peers/pile_step.h"

#include "engine/foundation/contract.h"
#include "engine/simulation/world.h"
#include "tests/bench/peers/carom_query.h"

namespace carom::bench {

std::vector<double> bulletStepTimes(const PlainPile& pile, int steps);
std::vector<double> odeStepTimes(const PlainPile& pile, int steps);

namespace {

PlainSolid plainSolid(const Solid& solid, double density_kgpm3) {
  const ConvexPolyhedron& core = solid.parts()[0].core;
  PlainSolid described;
  described.hull = plain(solid.parts()[0]);
  if (core.vertexCount() == 8 && core.faceCount() == 6) {  // all such solids of a pile are boxes
    Vec3 corner = Vec3::Zero();
    for (const Vec3& v : core.vertices()) corner = corner.cwiseMax(v);
    described.box_size = {2.0 * corner.x(), 2.0 * corner.y(), 2.0 * corner.z()};
  }
  const Mat3 I = density_kgpm3 * solid.unitInertia();
  described.mass = density_kgpm3 * solid.volume();
  described.inertia = {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)};
  return described;
}

std::vector<double> stepTimes(const PlainPile& pile, int steps, int threads) {
  World world({.step_s = pile.step_s,
               .gravity = Vec3(0, 0, -pile.gravity),
               .resting_mode = false,
               .threads = threads});
  for (const PlainSolid& solid : pile.solids) {
    std::vector<Vec3> vertices;
    for (const auto& v : solid.hull.vertices) vertices.emplace_back(v[0], v[1], v[2]);
    world.addSolid(Solid::polyhedron(ConvexPolyhedron::fromFaces(vertices, solid.hull.faces)));
  }
  for (const PlainBody& body : pile.bodies)
    world.addBody({body.solid,
                   posed(body.X_WB),
                   Vec3::Zero(),
                   Vec3::Zero(),
                   {pile.friction, pile.friction, 0.0, 1000.0},
                   body.is_static});
  REQUIRE(world.start().empty());
  return settledSteps(pile, steps, [&] { world.step(); });
}
std::vector<double> caromStepTimes(const PlainPile& pile, int steps) {
  return stepTimes(pile, steps, 1);
}
std::vector<double> twoThreadsStepTimes(const PlainPile& pile, int steps) {
  return stepTimes(pile, steps, 2);
}

}  // namespace

PlainPile plainPile(const World& world) {
  PlainPile pile;
  for (const Solid& solid : world.solids()) pile.solids.push_back(plainSolid(solid, 1000.0));
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    const BodyDescription& body = world.bodies()[i];
    pile.friction = body.material.dynamic_friction;
    pile.bodies.push_back({body.solid, plain(world.states()[i].X_WB), body.is_static});
  }
  return pile;
}

std::vector<PileStepper> pileSteppers() {
  std::vector<PileStepper> all{{"carom", caromStepTimes}, {"carom, 2 threads", twoThreadsStepTimes}};
#ifdef CAROM_BENCH_BULLET
  all.push_back({"bullet", bulletStepTimes});
#endif
#ifdef CAROM_BENCH_ODE
  all.push_back({"ode", odeStepTimes});
#endif
  return all;
}

}  // namespace carom::bench
