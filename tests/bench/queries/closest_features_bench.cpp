// Closest features, side by side with the peers in one run: the same hulls in the same poses. Options are
// Google Benchmark's; tests/bench/run.sh gives the usual ones. ODE gives no distance of parts that are apart.

#include <algorithm>
#include <cstdio>
#include <deque>

#include <benchmark/benchmark.h>

#include "tests/bench/peers/carom_query.h"
#include "tests/bench/peers/pose_loop.h"
#include "tests/bench/queries/ratio_table.h"

namespace carom::bench {
namespace {

constexpr int kSizes[] = {8, 20, 62, 252, 1000};

struct Lap {
  Motion motion;
  int n;
  const ConvexPart* part;
  std::vector<PosePair> poses;
};

void runLap(benchmark::State& state, const Library& library, const Lap& lap) {
  const Hull hull = plain(*lap.part);
  const std::unique_ptr<PairQuery> pair = library.makePair(hull, hull);
  pair->setPoses(lap.poses);
  const bool cold = lap.motion == Motion::kRandomSeparated;
  double sum = 0.0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < lap.poses.size(); ++i) {
      if (cold) pair->forget();
      sum += pair->ask(i);
    }
  }
  benchmark::DoNotOptimize(sum);
}

// How far our walks go, and the gaps that were asked about: a lap to warm up and one counted.
void printStates(const std::deque<Lap>& laps) {
  std::printf("\n%-19s%5s%12s%12s%12s%12s\n", "states a query", "n", "mean", "most", "least gap", "most gap");
  for (const Lap& lap : laps) {
    Memory memory{};
    long sum = 0;
    int most = 0;
    double least_m = kApart, most_m = -kApart;
    for (int round = 0; round < 2; ++round)
      for (const PosePair& poses : lap.poses) {
        if (lap.motion == Motion::kRandomSeparated) forget(memory);
        const ClosestFeatures c = ask(*lap.part, posed(poses.X_WA), *lap.part, posed(poses.X_WB), memory);
        sum += round * c.states;
        most = std::max(most, round * c.states);
        least_m = std::min(least_m, c.distance_m);
        most_m = std::max(most_m, c.distance_m);
      }
    std::printf("%-19s%5d%12.2f%12d%12.3f%12.3f\n", motionName(lap.motion), lap.n,
                double(sum) / double(lap.poses.size()), most, least_m, most_m);
  }
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  std::deque<ConvexPart> parts;
  for (int n : kSizes) parts.push_back(benchPart(n));
  std::deque<Lap> laps;
  for (int m = 0; m < static_cast<int>(Motion::kCount); ++m)
    for (const ConvexPart& part : parts) {
      const auto motion = static_cast<Motion>(m);
      laps.push_back({motion, part.core.vertexCount(), &part, poseLoop(motion, part, 1)});
    }
  const std::vector<Library> all = libraries();
  std::vector<std::string> names;
  for (const Library& library : all) names.push_back(library.name);
  for (const Lap& lap : laps)
    for (const Library& library : all) {
      const std::string name =
          std::string(motionName(lap.motion)) + "/" + library.name + "/" + std::to_string(lap.n);
      benchmark::RegisterBenchmark(name.c_str(),
                                   [&](benchmark::State& state) { runLap(state, library, lap); });
    }
  RatioTable table(names, kLap);
  for (const Lap& lap : laps) table.addRow(motionName(lap.motion), std::to_string(lap.n));
  benchmark::RunSpecifiedBenchmarks(&table);
  printStates(laps);
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  return carom::bench::run(argc, argv);
}
