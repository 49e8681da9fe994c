#pragma once
// The tolerances that decide what the simulation does, in one place and in order. A length written "per
// metre" is multiplied by the smaller width of the bodies concerned that can move, at most one metre.
// Tolerances of one algorithm (rounding of a slope, planarity of a face) stand in that algorithm's file with
// their reasons.

#include <cstddef>

namespace carom::tolerance {

// The collision window (paper §2.3, fig. 7), lengths per metre: floor < rest gap < landing < ceiling.

/// The paper's epsilon1: no pair is ever closer.
inline constexpr double kWindowFloor = 2.0e-4;
/// The gap that lasting contact is held at: residuals have a margin of 0.8 mm to the floor.
inline constexpr double kRestGap = 1.0e-3;
/// Of the rest gap, either way: lasting contact holds a gap in this band as it is.
inline constexpr double kRestBand = 0.1;
/// The gap at which a time of impact is sought: a contact that lasts is held as it came to be there.
inline constexpr double kLandingGap = 1.1e-3;
/// The paper's epsilon2: a collision of a pair that is closer is solved without a search for its time.
inline constexpr double kWindowCeiling = 2.0e-3;
/// Metres: a body that is larger has the window of this width.
inline constexpr double kWindowLargestScale = 1.0;

// Multi-point contact (paper §2.4, fig. 8).

/// The paper's distance k, per metre: above the ceiling, so that a tilted face keeps its far points while it
/// settles.
inline constexpr double kManifoldHeight = 5.0e-3;
/// The sine of 5 degrees: an edge or face that is flatter to a face lies on it.
inline constexpr double kLyingSine = 0.087;

// Substeps of bodies that move in contact.

/// Seconds: a step is halved into substeps until they are no longer than this ...
inline constexpr double kFineStep = 1.0 / 240.0;
/// ... nor h^2 a / r of a substep h above this, for a body of radius r that is pushed with the acceleration
/// a: a rod that tips over misses its energy by 0.07 of that, whatever its size.
inline constexpr double kFineFall = 2.0e-3;
/// Pairs of bodies that are awake, times substeps: where this is exceeded, the step has fewer substeps.
inline constexpr int kFinePairs = 300;

// Contact solver. Residuals are relative to the speed that gravity, or a load, adds in a step.

/// The residual of islands that the budget of row visits lets be solved with care.
inline constexpr double kSolverResidual = 1.0e-8;
/// Row visits: those of a step for all islands in which bodies move, those for all its events, and those for
/// each island that lies still. What needs more is solved to a coarser residual.
inline constexpr int kSolverRowVisits = 8000;
/// Sweeps that an island may have whatever the budget.
inline constexpr int kSolverSweeps = 24;
/// The residual of what moves, beyond the budget.
inline constexpr double kSolverCoarseResidual = 1.0e-3;
/// The residual of an island that lies still, beyond the budget.
inline constexpr double kSolverStandingResidual = 1.0e-5;
/// Row visits of a step where what moves has not come to the coarse residual within its budget.
inline constexpr int kSolverMostVisits = 50000;
/// Products of blocks for each row: a direct solve that takes more takes longer than the sweeps instead of
/// it.
inline constexpr long kSolverDearProducts = 16;
/// Of a surplus gap: what a contact that presses already closes of it in a step.
inline constexpr double kGapGain = 0.2;
/// m/s: a gap that is too small is reopened within a step, but no faster than this.
inline constexpr double kGapSpeed = 0.1;

// Events of one step.

/// Elastic events of a body up to which they are solved between the two bodies of a pair alone; impacts of a
/// pair after which those that turning alone brings back are none.
inline constexpr int kPairEvents = 8;
/// Events of a body up to which they are solved with all that the pair presses; then the body is frozen.
inline constexpr int kEventsPerBody = 24;
/// The restitution from which on events die out slowly.
inline constexpr double kNearlyElastic = 0.75;
/// How many times as many events a body has at that restitution.
inline constexpr int kNearlyElasticShare = 6;
/// Visits of contact rows for every body of the world; then impulses spread no further.
inline constexpr long kVisitsPerBody = 8000;
/// Poses that the searches for times of impact evaluate for every body of the world, a second's work for a
/// thousand bodies; then what a look does not clear is frozen.
inline constexpr long kSearchWorkPerBody = 5000;
/// The poses that they may evaluate in any world: 0.2 s.
inline constexpr long kLeastSearchWork = 1500000;
/// Events of a body before it is frozen, once impulses spread no further.
inline constexpr int kLateEventsPerBody = 6;

// Sliding (paper §2.4).

/// m/s: a contact that is slower has the static coefficient of friction.
inline constexpr double kSlipSpeed = 1e-5;
/// m/s along the contact: a body that is slower holds or rolls.
inline constexpr double kSlidingSpeed = 1e-3;

// Resting mode (paper §2.5).

/// m/s of any point of a body: one that is slower lies still.
inline constexpr double kRestSpeed = 0.02;
/// Seconds for which a body lies still before it is tested.
inline constexpr double kRestTime = 0.25;
/// Of gravity: forces that are balanced better than this hold a body.
inline constexpr double kRestAcceleration = 2e-5;
/// Sweeps of the solver in that test that any island may have.
inline constexpr int kRestSweeps = 400;
/// Row visits of the solver in that test: a small island may have more sweeps while they last.
inline constexpr int kRestRowVisits = 3000000;

// Swings about a rest (engine/modes/swinging.h).

/// Of the radius: a small swing lifts a body by less.
inline constexpr double kSwingRise = 2e-3;
/// 1/s, of the largest of small swings; smaller ones are damped more, up to half of critical.
inline constexpr double kSwingDamping = 4.0;

}  // namespace carom::tolerance
