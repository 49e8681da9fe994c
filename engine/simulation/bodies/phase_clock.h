#pragma once
// Where a step's time goes: the world says which of the paper's phases it is in, and whoever asked keeps the
// time. The engine itself reads no clock, and without a listener a phase costs a comparison with null. Phases
// nest; the inner one counts for itself. Tested in tests/engine/simulation/bodies/phase_clock_test.cpp.

#include <cstdint>

namespace carom {

enum class StepPhase : std::uint8_t {
  kForces,           ///< External forces: the paths of free flight.
  kBroadPhase,       ///< Swept bounds and candidate pairs.
  kClosestFeatures,  ///< Queries outside the search for times of impact.
  kImpulses,         ///< Lasting contacts and collisions.
  kTimeOfImpact,     ///< Searching events, with the queries this takes.
  kModes             ///< Resting, sliding, and publishing the states.
};
inline constexpr int kStepPhases = 6;

/// Told of every phase's beginning and end. Must not touch the world.
class PhaseClock {
 public:
  virtual ~PhaseClock() = default;
  virtual void begin(StepPhase phase) = 0;
  /// Of the phase that began last and has not ended.
  virtual void end() = 0;
};

/// A phase that lasts as long as this lives.
class PhaseScope {
 public:
  PhaseScope(PhaseClock* clock, StepPhase phase) : clock_(clock) {
    if (clock_ != nullptr) clock_->begin(phase);
  }
  ~PhaseScope() {
    if (clock_ != nullptr) clock_->end();
  }
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

 private:
  PhaseClock* clock_;
};

}  // namespace carom
