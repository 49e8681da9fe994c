#pragma once
// What `carom budget` found out, ready to be told: what was measured, every replay, the least times and the
// verdict. Tested in tests/demos/report/budget_report_test.cpp.

#include <optional>
#include <string>

#include "demos/budget/budget_verdict.h"
#include "demos/budget/frame_statistics.h"
#include "demos/budget/replays.h"

namespace carom::demos {

/// What must be the same for two measurements to be compared.
struct BudgetSubject {
  std::string scene;
  std::string scene_hash;  ///< With meshes and seed.
  int width = 0;
  int height = 0;
  double fps = 0.0;
  int frames = 0;
  std::string camera;
  std::string preset;
  int threads = 1;       ///< That step.
  std::string machine;   ///< CPU and cores.
  std::string renderer;  ///< What draws.
  std::string build;
  std::string clock =
      "wall";  ///< What times are: on the wall, or of the CPU in all of the process's threads.
};

struct BudgetGate {
  double budget_ms = 0.0;
  double percent = 0.0;
};
/// "p99", "p99.9"
std::string percentileName(double percent);

struct BudgetResult {
  BudgetSubject subject;
  BudgetGate gate;
  std::vector<Replay> replays;
  std::optional<double> outside_load;  ///< Nothing where the system does not tell.
  std::vector<FrameCost> least;
  TimeEvidence evidence;
  BudgetVerdict verdict = BudgetVerdict::kInconclusive;
};

/// Throws SimulationInvalid when the replays' states differ.
BudgetResult judged(const BudgetSubject& subject, const BudgetGate& gate, std::vector<Replay> replays,
                    std::optional<double> outside_load);

/// Why the evidence decides nothing: "the replays differ by a factor of 1.4 and others used 30 % of the CPU".
std::string noiseText(const TimeEvidence& evidence);
/// "over: p99 18.2 ms, budget 16.7 ms, 1.5 ms (9 %) too slow"
std::string verdictLine(const BudgetResult& result);

}  // namespace carom::demos
