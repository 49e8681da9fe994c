#pragma once
// What one frame cost, phase by phase, and what there was to do in it. Plain values: the statistics, the
// verdict and the reports of `carom budget` are functions of these alone.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/simulation/bodies/phase_clock.h"

namespace carom::demos {

/// The step's phases, as the world names them, then those of the picture.
enum class FramePhase : std::uint8_t {
  kForces,
  kBroadPhase,
  kClosestFeatures,
  kImpulses,
  kTimeOfImpact,
  kModes,
  kDraw,
  kReadback,  ///< Out of GL, with the smoothing of edges.
  kEncode,    ///< PNG, in memory.
  kOther      ///< What is left: poses between steps, the audit, the list of what to draw.
};
inline constexpr std::size_t kFramePhases = 10;
inline constexpr std::array<const char*, kFramePhases> kFramePhaseNames = {
    "forces", "broad phase", "closest features", "impulses", "time of impact",
    "modes",  "draw",        "readback",         "encode",   "other"};

constexpr FramePhase framePhase(StepPhase phase) {
  return static_cast<FramePhase>(phase);
}
static_assert(framePhase(StepPhase::kModes) == FramePhase::kModes && kStepPhases == 6);

/// What there was to do, exactly: the same for any number of threads, on any machine, under any load.
enum class Work : std::uint8_t {
  kSteps,  ///< With substeps.
  kPairs,
  kQueries,
  kStatesWalked,  ///< Pairs of features visited by the queries.
  kContactPoints,
  kRowVisits,  ///< Of contact rows, in all sweeps.
  kLandings,
  kProjectedPaths,
  kClearedPaths,
  kEvents,
  kImpacts,
  kNewtonSteps,
  kTriangles,
  kPixels,
  kShadowTexels,
  kMirrorTexels,
  kBands,  ///< Of the picture that are not as in the one before.
  kBytes   ///< Of the PNG.
};
inline constexpr std::size_t kWorkKinds = 18;
/// A kind's name and the phase that it costs time in.
struct WorkKind {
  const char* name;
  FramePhase phase;
};
inline constexpr std::array<WorkKind, kWorkKinds> kWork = {{{"steps", FramePhase::kForces},
                                                            {"candidate pairs", FramePhase::kBroadPhase},
                                                            {"queries", FramePhase::kClosestFeatures},
                                                            {"states walked", FramePhase::kClosestFeatures},
                                                            {"contact points", FramePhase::kImpulses},
                                                            {"row visits", FramePhase::kImpulses},
                                                            {"landings", FramePhase::kImpulses},
                                                            {"projected paths", FramePhase::kImpulses},
                                                            {"cleared paths", FramePhase::kTimeOfImpact},
                                                            {"events", FramePhase::kTimeOfImpact},
                                                            {"impacts", FramePhase::kTimeOfImpact},
                                                            {"newton steps", FramePhase::kTimeOfImpact},
                                                            {"triangles", FramePhase::kDraw},
                                                            {"pixels drawn", FramePhase::kDraw},
                                                            {"shadow texels", FramePhase::kDraw},
                                                            {"mirror texels", FramePhase::kDraw},
                                                            {"bands packed", FramePhase::kEncode},
                                                            {"bytes packed", FramePhase::kEncode}}};
using WorkCounts = std::array<std::int64_t, kWorkKinds>;
inline constexpr std::int64_t kNotCounted = -1;  ///< By a program that does not know the kind.

struct FrameCost {
  int frame = 0;
  double time_s = 0.0;           ///< Of the scene.
  std::uint64_t state_hash = 0;  ///< Of the world at the frame.
  std::array<double, kFramePhases> phase_ms{};
  double total_ms = 0.0;  ///< On the clock, from the frame's beginning to its end.
  int contacts = 0;       ///< Contact points; the most in a step of the frame.
  int pairs = 0;          ///< Candidate pairs; the most in a step of the frame.
  int queries = 0;        ///< Closest-feature queries of all its steps.
  int events = 0;         ///< Times of impact of all its steps.
  WorkCounts work{};      ///< Sums over all its steps.
  std::int64_t& worked(Work kind) { return work[static_cast<std::size_t>(kind)]; }
};

/// A stretch of one phase on the clock; stretches nest.
struct PhaseSlice {
  int frame = 0;
  FramePhase phase = FramePhase::kOther;  ///< kOther: the whole frame.
  double begin_us = 0.0;                  ///< Since the replay's beginning.
  double length_us = 0.0;
};

/// One run of the scene from its beginning.
struct Replay {
  std::vector<FrameCost> frames;
  std::vector<PhaseSlice> slices;  ///< Empty unless asked for.
};

}  // namespace carom::demos
