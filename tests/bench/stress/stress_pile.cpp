// stress pile: drops the bodies, asks the overlap oracle in every step, or every few, and keeps the time of
// every phase. The settled heap is then stepped again from rest without resting mode, by ours and by each
// peer that is there.

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "demos/motion/phase_stopwatch.h"
#include "engine/contact/collision_window.h"
#include "tests/bench/peers/pile_step.h"
#include "tests/bench/stress/stress.h"
#include "tests/oracle/overlap_oracle.h"

namespace carom::bench {
namespace {

using demos::FrameCost;

double clockSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct PileCounts {
  double engine_gap_m = std::numeric_limits<double>::infinity();
  double oracle_gap_m = std::numeric_limits<double>::infinity();
  double oracle_gap_floors = std::numeric_limits<double>::infinity();  ///< In floors of the pair's window.
  int oracle_frames = 0, overlapping_frames = 0;
  long stalled = 0, events = 0, queries = 0;
  double first_all_rest_s = -1.0;  ///< Negative: never.
  int resting = 0, escaped = 0;
  std::vector<FrameCost> steps;
};

double windowFloor(const World& world, const oracle::SmallestGap& gap) {
  const auto partOf = [&world](int body) -> const ConvexPart& {
    const int solid = world.bodies()[static_cast<std::size_t>(body)].solid;
    return world.solids()[static_cast<std::size_t>(solid)].parts()[0];
  };
  return collisionWindow(partOf(gap.body_a), partOf(gap.body_b)).floor;
}

PileCounts drop(BinPile& pile, const PileRun& run) {
  PileCounts counts;
  oracle::RememberedAxes axes;
  demos::PhaseStopwatch watch(clockSeconds, false);
  const int steps = static_cast<int>(std::lround(run.seconds * run.rate_hz));
  for (int i = 1; i <= steps; ++i) {
    watch.beginFrame(i);
    pile.world().step(&watch);
    watch.endFrame(counts.steps.emplace_back());
    const Audit audit = pile.world().audit();
    counts.engine_gap_m = std::min(counts.engine_gap_m, audit.smallest_gap_m);
    counts.stalled += audit.last_step.stopped_bodies;
    counts.events += audit.last_step.events;
    counts.queries += audit.last_step.distance_queries;
    counts.resting = audit.resting_bodies;
    if (counts.resting < pile.plan().bodies)
      counts.first_all_rest_s = -1.0;
    else if (counts.first_all_rest_s < 0.0)
      counts.first_all_rest_s = audit.time_s;
    if (i % run.oracle_every != 0 && i != steps) continue;
    const oracle::SmallestGap gap = oracle::smallestGap(pile.world(), &axes);
    ++counts.oracle_frames;
    if (!(gap.gap_m > 0.0)) {
      ++counts.overlapping_frames;
      std::fprintf(stderr, "step %d: bodies %d and %d overlap by %.3g m\n", i, gap.body_a, gap.body_b,
                   -gap.gap_m);
    }
    if (gap.gap_m < counts.oracle_gap_m)
      counts.oracle_gap_floors = gap.gap_m / windowFloor(pile.world(), gap);
    counts.oracle_gap_m = std::min(counts.oracle_gap_m, gap.gap_m);
  }
  counts.escaped = pile.escaped();
  return counts;
}

double percentile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

// The mean of the second that took longest.
double slowestSecond(const std::vector<double>& ms, double rate_hz) {
  const auto window = std::min(ms.size(), static_cast<std::size_t>(std::lround(rate_hz)));
  double sum = 0.0, most = 0.0;
  for (std::size_t i = 0; i < ms.size(); ++i) {
    sum += ms[i];
    if (i >= window) sum -= ms[i - window];
    if (i + 1 >= window) most = std::max(most, sum);
  }
  return most / static_cast<double>(window);
}

void printCost(const char* name, const std::vector<double>& ms, double rate_hz) {
  std::printf("  %-17s %9.3f %9.3f %9.3f\n", name, percentile(ms, 0.5), percentile(ms, 0.99),
              slowestSecond(ms, rate_hz));
}

void printCosts(const PileCounts& counts, double rate_hz) {
  std::printf("  %-17s %9s %9s %9s\n", "ms a step", "median", "p99", "slowest s");
  std::vector<double> ms(counts.steps.size());
  std::transform(counts.steps.begin(), counts.steps.end(), ms.begin(),
                 [](const FrameCost& c) { return c.total_ms; });
  printCost("all", ms, rate_hz);
  for (std::size_t phase = 0; phase < kStepPhases; ++phase) {
    std::transform(counts.steps.begin(), counts.steps.end(), ms.begin(),
                   [phase](const FrameCost& c) { return c.phase_ms[phase]; });
    printCost(demos::kFramePhaseNames[phase], ms, rate_hz);
  }
}

// Every bar of the invariant; times are reported only, a machine's load is not ours.
bool printCounts(const PilePlan& plan, const PileCounts& counts, double seconds) {
  const double body_steps = static_cast<double>(counts.steps.size()) * plan.bodies;
  const double stalled = static_cast<double>(counts.stalled) / body_steps;
  const bool must_rest = plan.friction >= 0.5 && seconds >= 20.0;
  const bool rests = counts.first_all_rest_s >= 0.0;
  std::printf("  overlapping frames %d of %d (bar 0); smallest gap by the oracle %.3g m, %.3f of its floor\n",
              counts.overlapping_frames, counts.oracle_frames, counts.oracle_gap_m, counts.oracle_gap_floors);
  std::printf("  smallest gap in any step %.3g m (bar > 0)\n", counts.engine_gap_m);
  std::printf("  stalled %.4f %% of body-steps (bar 0.1 %%); escaped %d (bar 0)\n", 100.0 * stalled,
              counts.escaped);
  if (rests)
    std::printf("  all at rest from %.2f s%s\n", counts.first_all_rest_s, must_rest ? " (bar 20 s)" : "");
  else
    std::printf("  %d of %d at rest at %g s%s\n", counts.resting, plan.bodies, seconds,
                must_rest ? " (bar: all)" : "");
  std::printf("  a body and step: %.3f events, %.2f queries\n",
              static_cast<double>(counts.events) / body_steps,
              static_cast<double>(counts.queries) / body_steps);
  const bool met = counts.overlapping_frames == 0 && counts.engine_gap_m > 0.0 && stalled < 1e-3 &&
                   counts.escaped == 0 && (rests || !must_rest);
  std::printf("  %s\n", met ? "met" : "MISSED");
  return met;
}

void compareSettled(const BinPile& pile, int steps) {
  const PlainPile plain = plainPile(pile.world());
  std::printf("  settled, resting off, %d steps of 1/60 s: ms a step (p99 / median: bar 3)\n", steps);
  for (const PileStepper& stepper : pileSteppers()) {
    const std::vector<double> ms = stepper.stepTimes_ms(plain, steps);
    const double median = percentile(ms, 0.5), p99 = percentile(ms, 0.99);
    std::printf("    %-16s %9.3f  p99 %9.3f  (%.1f)\n", stepper.name, median, p99, p99 / median);
    std::fflush(stdout);
  }
}

bool runOne(const PileRun& run, PileOf of, double friction) {
  const bool hulls = of == PileOf::kHulls;
  const PilePlan plan{.of = of,
                      .bodies = run.bodies > 0 ? run.bodies : (hulls ? 1000 : 5000),
                      .friction = friction,
                      .rate_hz = run.rate_hz,
                      .seed = run.seed,
                      .threads = run.threads};
  std::printf("%d %s, friction %g, %g s at %g Hz, threads %d\n", plan.bodies, hulls ? "hulls" : "boxes",
              friction, run.seconds, run.rate_hz, run.threads);
  std::fflush(stdout);
  BinPile pile(plan);
  if (!pile.world().start().empty()) {
    std::printf("  bodies overlap at the start\n");
    return false;
  }
  const PileCounts counts = drop(pile, run);
  const bool met = printCounts(plan, counts, run.seconds);
  printCosts(counts, run.rate_hz);
  if (run.peer_steps > 0) compareSettled(pile, run.peer_steps);
  std::fflush(stdout);
  return met;
}

}  // namespace

bool runPiles(const PileRun& run) {
  bool met = true;
  for (PileOf of : run.kinds)
    for (double friction : run.frictions) met &= runOne(run, of, friction);
  return met;
}

}  // namespace carom::bench
