#pragma once
// The world: bodies that share solids, and the fixed step of the paper:
//   external forces -> candidate pairs -> closest features -> impulses -> advance to the next time of impact
//   -> modes
// A long step in which few bodies move in contact goes through them several times, in substeps (DEVIATES: the
// paper has one length of step for all). Invariant: after `start` has accepted the bodies, every pair keeps a
// gap > 0 at every instant (collision_window.h). Deterministic: the same calls give the same bits.
// Nothing in here draws, prints or reads a clock. Tested in tests/engine/simulation/ and tests/physics/.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/foundation/frames.h"
#include "engine/simulation/bodies/phase_clock.h"
#include "engine/simulation/bodies/step_view.h"
#include "engine/simulation/bodies/world_types.h"
#include "engine/solid/solid.h"

namespace carom {

class World {
 public:
  explicit World(const WorldSettings& settings);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  int addSolid(Solid solid);
  int addBody(const BodyDescription& description);

  /// Checks the starting poses; must be called once before the first step. All overlapping pairs of bodies,
  /// deepest first; when there are any the world must not be stepped. Where gaps are below those that lasting
  /// contact holds (bodies that touch), bodies are moved along their free axes, not turned, by as little as
  /// opens them; energies and all that follows are those of the poses that `states` then has.
  std::vector<Overlap> start();
  /// Advances by exactly one step; tells `clock` of its phases, which changes no bit of the outcome. While
  /// few bodies are in contact and move, it is made in substeps: of 1/240 s at most, and shorter for small
  /// ones. Throws TooManyPairs, as does `start`, where more bodies come near each other than it can keep in
  /// mind; the world must then not be stepped any more. Nor must it after a step that ends with a state that
  /// is not finite, which is the step's last.
  void step(PhaseClock* clock = nullptr);

  /// From now on `view` is told of every step (and at once of the pairs and bounds of the start), which
  /// changes no bit of the outcome; null: nothing is told any more. `view` must outlive that.
  void watch(StepView* view);

  /// From now on the bodies' paths through each step are kept for `statesWithin`, or not any more, which
  /// changes no bit of the outcome.
  void keepPaths(bool keep);
  /// The bodies `share`, in [0, 1], of the way through the last step, whose paths were kept: on the paths
  /// that keep every gap > 0, with the modes of the step's end.
  void statesWithin(double share, std::vector<BodyState>& states) const;

  double time() const;
  int stepCount() const;
  const WorldSettings& settings() const;
  std::span<const Solid> solids() const;
  std::span<const BodyState> states() const;
  std::span<const BodyDescription> bodies() const;
  double mass(int body) const;  ///< kg; infinite for a static body.
  Audit audit() const;
  /// FNV-1a over the bits of time, poses, velocities and modes.
  std::uint64_t stateHash() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
