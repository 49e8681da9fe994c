#include "tests/explore/watch/world_judge.h"

#include <algorithm>
#include <utility>

namespace carom::explore {
namespace {

constexpr double kFrozenBar = 1e-3;        // of the body-steps; a run of hundreds can tell ten times that
constexpr double kEventsBar = 24 * 6 * 8;  // of a step and body: the engine's stated budget at its largest

// The volume of a thin solid is a sum of tetrahedra that nearly cancel: a thousandth of its size times
// rounding.
constexpr Real kMassBar = 1e-9L;

bool allFinite(std::span<const BodyState> states) {
  return std::all_of(states.begin(), states.end(), [](const BodyState& s) {
    return s.X_WB.position.allFinite() && s.X_WB.rotation.coeffs().allFinite() &&
           s.linear_velocity.allFinite() && s.angular_velocity.allFinite();
  });
}

}  // namespace

WorldJudge::WorldJudge(const demos::Scene& scene, const World& world)
    : scene_(scene),
      world_(world),
      bodies_(ownBodies(world)),
      start_(mechanicsOf(bodies_, world.states(), world.settings().gravity)),
      energy_(world, bodies_, start_),
      flight_(world, bodies_, world.states()),
      glide_(scene, world),
      leap_(world, bodies_),
      kinetic_before_J_(start_.kinetic_J),
      moved_(world),
      loads_(world, bodies_),
      momentum_(world, bodies_, start_),
      apart_(world) {
  const Air& air = world.settings().air;
  const bool dry = world.settings().fluids.empty();
  keeps_energy_ = dry && (!(air.density_kgpm3 > 0.0) || air.wind.isZero(0.0));
  const auto all = [&world](bool (*has)(const BodyDescription&)) {
    return std::all_of(world.bodies().begin(), world.bodies().end(), has);
  };
  knows_work_ = loads_.any() && dry && !(air.density_kgpm3 > 0.0) &&
                all([](const BodyDescription& d) { return !d.is_kinematic && !d.load.bends(); });
  checkMasses();
  lookForOverlap(world.states(), "overlap", 0);
}

bool WorldJudge::look(std::span<const BodyState> states, const StepCounters& counters, int step) {
  count(counters, step);
  if (!allFinite(states)) {
    findings_.add("nan", 1.0, step, "a state is not finite");
    return false;
  }
  lookForOverlap(states, "overlap", step);
  const Mechanics now = mechanicsOf(bodies_, states, world_.settings().gravity);
  if (keeps_energy_) {
    const EnergyWatch::Gain gain = energy_.after(
        now, flight_.after(states, step, findings_) + workOfStep(counters, step), loads_.sum().work_scale_J);
    totals_.worst_gain = std::max(totals_.worst_gain, gain.of_tolerance);
    if (gain.of_scale > 0.0) findings_.add("energy", gain.of_scale, step, gain.detail);
    leap_.after(states, kinetic_before_J_ + now.kinetic_J + std::abs(Real{counters.work_J}), step, findings_);
  }
  kinetic_before_J_ = now.kinetic_J;
  momentum_.after(now, states, {step, counters.rest_test_rows > 0, loads_.sum()}, findings_);
  glide_.look(states, step, findings_);
  moved_.look(states, world_.audit().kinematic_late_s, step, findings_);
  return true;
}

void WorldJudge::lookBetween(std::span<const BodyState> states, int step) {
  if (allFinite(states)) lookForOverlap(states, "overlap-between", step);
}

void WorldJudge::conclude(int step) {
  const auto all = static_cast<double>(std::max(1L, totals_.body_steps));
  const double share = static_cast<double>(totals_.stopped) / all;
  if (share > 10 * kFrozenBar)
    findings_.add(
        "frozen", share, step,
        std::to_string(totals_.stopped) + " of " + std::to_string(totals_.body_steps) + " body-steps");
}

void WorldJudge::checkMasses() {
  for (const OwnBody& body : bodies_) {
    const Real error = std::abs(Real{world_.mass(body.index)} - body.mass) / body.mass;
    const Real off = body.center_B.norm() / body.reach_m;
    if (error > kMassBar || off > kMassBar)
      findings_.add("mass", static_cast<double>(std::max(error, off)), 0,
                    "of " + scene_.bodies[static_cast<std::size_t>(body.index)].name);
  }
}

void WorldJudge::lookForOverlap(std::span<const BodyState> states, const char* kind, int step) {
  const std::optional<Meeting> meeting = apart_.deepest(states);
  if (!meeting) return;
  const auto name = [this](int body) { return scene_.bodies[static_cast<std::size_t>(body)].name; };
  findings_.add(
      kind, meeting->depth_m, step,
      name(meeting->body_a) + " and " + name(meeting->body_b) + " by " + shown(meeting->depth_m) + " m");
}

void WorldJudge::count(const StepCounters& counters, int step) {
  const auto bodies = static_cast<double>(std::max<std::size_t>(1, bodies_.size()));
  ++totals_.steps;
  totals_.body_steps += static_cast<long>(bodies_.size());
  totals_.stopped += counters.stopped_bodies;
  totals_.queries += counters.distance_queries;
  totals_.events += counters.events;
  totals_.most_events = std::max(totals_.most_events, counters.events / bodies);
  totals_.most_queries = std::max(totals_.most_queries, counters.distance_queries / bodies);
  if (counters.events / bodies > kEventsBar)
    findings_.add("events", counters.events / bodies, step, "events a body in one step");
}

// By kinematic bodies and loads, J. Where it can be told from the paths alone, the engine's account is not
// believed but compared.
Real WorldJudge::workOfStep(const StepCounters& counters, int step) {
  if (!knows_work_) return counters.work_J;
  const Pushed& pushed = loads_.sum();
  told_J_ += counters.work_J;
  const Real off = std::abs(told_J_ - pushed.work_J);
  if (off > kRounding * step * pushed.work_scale_J)
    findings_.add("work", static_cast<double>(off / pushed.work_scale_J), step,
                  shown(static_cast<double>(told_J_)) + " J told, " +
                      shown(static_cast<double>(pushed.work_J)) + " J on the paths");
  return pushed.work_J - std::exchange(pushed_J_, pushed.work_J);
}

}  // namespace carom::explore
