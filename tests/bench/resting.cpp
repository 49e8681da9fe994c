// resting: what a world at rest costs. Boxes in stacks of four stand side by side, and sixty more are thrown
// up above them and stay in flight: how long it takes to set them up, the first step, the step in which they
// come to rest, and every step thereafter, which is to be the same however many rest. Bullet, where it is
// there, steps the same world with its own sleeping. Prints a table in Markdown.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "engine/foundation/contract.h"
#include "engine/simulation/world.h"
#include "tests/bench/peers/carom_query.h"
#include "tests/bench/peers/pile_step.h"

namespace carom::bench {
namespace {

constexpr int kFlying = 60;
constexpr int kLevels = 4;
constexpr double kSize_m = 0.5, kPitch_m = 0.75;
constexpr double kRate_hz = 60.0;
constexpr double kUp_mps = 40.0;  // eight seconds of flight

struct Plan {
  int bodies = 1000;
  double seconds = 4.0;
  double gap_m = 0.0005;  ///< Between the boxes of a stack; 0: they touch.
  int threads = 1;
};

double clockMs() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

World restingWorld(const Plan& plan) {
  World world({.step_s = 1.0 / kRate_hz, .threads = plan.threads});
  const int stacks = (plan.bodies + kLevels - 1) / kLevels;
  const int side = static_cast<int>(std::ceil(std::sqrt(stacks)));
  const double width = side * kPitch_m + 20.0;
  const int box = world.addSolid(Solid::box(Vec3::Constant(kSize_m)));
  const int flyer = world.addSolid(Solid::box({0.3, 0.4, 0.5}));
  const int floor = world.addSolid(Solid::box({width, width, 1.0}));
  const auto add = [&](int solid, const Vec3& p, const Vec3& velocity, bool is_static) {
    const Material material{0.5, 0.5, 0.0, 1000.0};
    world.addBody({solid, {Quat::Identity(), p}, velocity, Vec3::Zero(), material, is_static});
  };
  add(floor, {0, 0, -0.5}, Vec3::Zero(), true);
  for (int i = 0; i < plan.bodies; ++i) {
    const int stack = i / kLevels, level = i % kLevels;
    add(box,
        {kPitch_m * (stack % side - 0.5 * side), kPitch_m * (stack / side - 0.5 * side),
         0.5 * kSize_m + plan.gap_m + (kSize_m + plan.gap_m) * level},
        Vec3::Zero(), false);
  }
  for (int i = 0; i < kFlying; ++i)
    add(flyer, {i % 10 - 5.0, i / 10 - 3.0, 10.0 + i % 7}, {i % 5 - 2.0, i % 3 - 1.0, kUp_mps}, false);
  return world;
}

struct Times {
  double set_up_ms = 0.0, first_ms = 0.0;
  double to_rest_ms = std::nan("");  ///< The step in which most come to rest.
  std::vector<double> at_rest_ms;    ///< From the second step after the last of them did.
  int active_bodies = 0;             ///< In the last step.
};

// Ours.
Times stepWorld(const Plan& plan) {
  Times times;
  const double begin = clockMs();
  World world = restingWorld(plan);
  REQUIRE(world.start().empty());
  times.set_up_ms = clockMs() - begin;
  int most = 0, resting = 0, since_rest = 0;
  for (int i = 0; i < static_cast<int>(plan.seconds * kRate_hz); ++i) {
    const double before = clockMs();
    world.step();
    const double ms = clockMs() - before;
    if (i == 0) times.first_ms = ms;
    const Audit audit = world.audit();
    if (audit.resting_bodies - resting > most) {
      most = audit.resting_bodies - resting;
      times.to_rest_ms = ms;
    }
    resting = audit.resting_bodies;
    since_rest = resting >= plan.bodies ? since_rest + 1 : 0;
    if (since_rest > 2) times.at_rest_ms.push_back(ms);
    times.active_bodies = audit.last_step.active_bodies;
  }
  return times;
}

// A peer says nothing of who sleeps; its last second counts.
Times stepPeer(const Plan& plan, const PileStepper& peer) {
  World world = restingWorld(plan);
  REQUIRE(world.start().empty());
  PlainPile pile = plainPile(world);
  pile.sleeps = true;
  for (std::size_t i = 0; i < pile.bodies.size(); ++i) {
    const Vec3& v = world.states()[i].linear_velocity;
    pile.bodies[i].velocity = {v.x(), v.y(), v.z()};
  }
  Times times;
  const double begin = clockMs();
  const std::vector<double> ms = peer.stepTimes_ms(pile, static_cast<int>(plan.seconds * kRate_hz));
  times.set_up_ms = clockMs() - begin;  // and taken down
  for (const double step : ms) times.set_up_ms -= step;
  times.first_ms = ms.front();
  times.at_rest_ms.assign(ms.end() - std::min(ms.end() - ms.begin(), static_cast<std::ptrdiff_t>(kRate_hz)),
                          ms.end());
  return times;
}

void printRow(const Plan& plan, const char* engine, const Times& times) {
  std::printf("| %d | %s | %.1f | %.1f | ", plan.bodies, engine, times.set_up_ms, times.first_ms);
  if (std::isnan(times.to_rest_ms))
    std::printf("- | ");
  else
    std::printf("%.1f | ", times.to_rest_ms);
  std::printf("%.3f (%.3f) | ", percentile(times.at_rest_ms, 0.5), percentile(times.at_rest_ms, 0.99));
  if (times.active_bodies > 0)
    std::printf("%d |\n", times.active_bodies);
  else
    std::printf("- |\n");
  std::fflush(stdout);
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  using namespace carom::bench;
  CLI::App app{"Sixty boxes in flight over many at rest: milliseconds of the steps that matter."};
  app.option_defaults()->always_capture_default();
  Plan plan;
  std::vector<int> bodies{1000, 8000, 20000};
  app.add_option("--bodies", bodies, "at rest")->check(CLI::Range(1, 100000));
  app.add_option("--seconds", plan.seconds)->check(CLI::Range(1.0, 7.0));
  app.add_option("--gap", plan.gap_m, "metres between boxes at the start")->check(CLI::Range(0.0, 0.01));
  app.add_option("--threads", plan.threads)->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "| at rest | engine | set up, ms | first step | step that rests most | 60 in flight, median (p99) "
      "| bodies looked at |\n|---|---|---|---|---|---|---|\n");
  for (const int count : bodies) {
    plan.bodies = count;
    printRow(plan, "carom", stepWorld(plan));
    for (const PileStepper& peer : pileSteppers())
      if (std::string_view(peer.name) == "bullet") printRow(plan, peer.name, stepPeer(plan, peer));
  }
  return 0;
}
