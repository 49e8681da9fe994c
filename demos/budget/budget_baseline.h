#pragma once
// An earlier result to hold this one against: which phase got slower. Phases are compared by their mean over
// the frames, of each frame's least time over the replays, which is the steadiest figure there is; the frame
// also at the budget's percentile. Tested in tests/demos/budget/budget_baseline_test.cpp.

#include <array>
#include <cstdint>
#include <filesystem>

#include "demos/budget/budget_result.h"

namespace carom::demos {

/// What a kind of work was in every frame; empty where the file is of an older program.
using WorkHistory = std::array<std::vector<std::int64_t>, kWorkKinds>;

struct Baseline {
  std::string file;
  BudgetSubject subject;
  std::array<double, kFramePhases> phase_mean_ms{};
  double frame_mean_ms = 0.0;
  double percent = 0.0;
  double at_percentile_ms = 0.0;
  WorkHistory work;
  std::uint64_t final_state = 0;
  std::vector<double> frame_times_ms;  ///< Empty where the file is of an older program.
  bool hasWork() const { return !work[0].empty(); }
};
/// What `carom budget --json` wrote. Throws InputError.
Baseline readBaseline(const std::filesystem::path& path);

/// Throws InputError that names what differs (scene, size, frames, machine...).
void requireSameSubject(const Baseline& baseline, const BudgetSubject& subject);

/// The same of what the work depends on alone: not of the machine, the renderer, the build and the threads.
void requireSameRun(const Baseline& baseline, const BudgetSubject& subject);
/// Why times cannot be compared: "machine: a, not b"; empty: they can.
std::string otherMachine(const Baseline& baseline, const BudgetSubject& subject);

/// A kind of work that is not in every frame what it was.
struct WorkChange {
  std::size_t kind = 0;                          ///< Index into kWork.
  std::int64_t before = 0, now = 0;              ///< Of all frames.
  int first_frame = 0;                           ///< The first that differs.
  std::int64_t frame_before = 0, frame_now = 0;  ///< Of that frame.
  bool is_over = false;                          ///< Grew by more than the tolerance.
};

struct PhaseChange {
  std::string name;    ///< A phase's, or "frame".
  std::string figure;  ///< "mean", "p99"
  double before_ms = 0.0;
  TimeEvidence evidence;  ///< Against what was plus the tolerance.
  BudgetVerdict verdict = BudgetVerdict::kWithin;
};

struct BaselineComparison {
  std::string file;
  double tolerance_percent = 0.0;
  std::vector<PhaseChange> changes;  ///< All phases, then the frame's figures.
  BudgetVerdict verdict = BudgetVerdict::kWithin;
  double work_tolerance_percent = 0.0;
  std::vector<WorkChange> work;
  bool has_work = false;      ///< The baseline tells of work at all.
  bool other_states = false;  ///< The run ends elsewhere: other work is no wonder.
  std::string other_machine;  ///< Why no times were compared; empty: they were.
};

/// A growth below this is the clock's own, not the phase's.
inline constexpr double kLeastGrowth_ms = 0.002;
/// Nor is one below this share of a whole frame: phases of a few microseconds were seen to grow by up to
/// half, each up to 0.25 % of the frame, on an idle machine from one run of the program to the next.
inline constexpr double kLeastShareOfFrame = 0.005;

BaselineComparison comparedToBaseline(const BudgetResult& result, const Baseline& baseline,
                                      double tolerance_percent, double work_tolerance_percent = 0.0);

/// "slower: draw mean 5.1 ms, was 4.2 ms (+20 %, tolerance 10 %)", a line for each that is not within; or one
/// that nothing is slower.
std::vector<std::string> baselineLines(const BaselineComparison& comparison);

}  // namespace carom::demos
