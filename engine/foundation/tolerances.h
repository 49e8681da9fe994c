#pragma once
// The tolerances that decide what the simulation does, in one place and in order. A length written "per
// metre" is multiplied by the smaller width of the bodies concerned that can move, at most one metre.
// Tolerances of one algorithm (rounding of a slope, planarity of a face) stand in that algorithm's file with
// their reasons.

#include <cstddef>

namespace carom::tolerance {

// The collision window (paper §2.3, fig. 7), lengths per metre: floor < rest gap < landing < ceiling.
inline constexpr double kWindowFloor = 2.0e-4;  // epsilon1: no pair is ever closer
inline constexpr double kRestGap = 1.0e-3;  // lasting contact is held here: a margin of 0.8 mm for residuals
inline constexpr double kRestBand =
    0.1;  // of the rest gap, either way: gaps in this band are held as they are
inline constexpr double kLandingGap = 1.1e-3;  // where a time of impact aims: held as it is when it lasts
inline constexpr double kWindowCeiling =
    2.0e-3;  // epsilon2: closer than this, a collision is solved directly
inline constexpr double kWindowLargestScale = 1.0;  // metres; larger bodies keep the window of a metre

// Multi-point contact (paper §2.4, fig. 8).
inline constexpr double kManifoldHeight = 5.0e-3;  // the distance k, per metre: above the ceiling, so that a
                                                   // tilted face keeps its far points while it settles
inline constexpr double kLyingSine = 0.087;  // 5 degrees: an edge or face flatter than this lies on the face

// Substeps of bodies that move in contact.
inline constexpr double kFineStep = 1.0 / 240.0;  // s: substeps are no longer, unless ...
inline constexpr int kMostSubsteps = 8;           // ... they are so many, or ...
inline constexpr int kFinePairs = 300;  // times substeps: where more pairs are awake, these are fewer

// Contact solver: relative to the speed that gravity adds in a step.
inline constexpr double kSolverResidual = 1.0e-8;  // a sweep that changes speeds less has converged
inline constexpr int kSolverRowVisits = 8000;    // of a step by what moves, of an island that stands, and ...
inline constexpr int kSolverSweeps = 60;         // ... at least so many sweeps, ...
inline constexpr int kSolverFocusedSweeps = 24;  // ... of crowds that stand so many; above that, ...
inline constexpr double kSolverCoarseResidual = 1.0e-3;    // ... this is enough for what moves, ...
inline constexpr double kSolverStandingResidual = 1.0e-5;  // ... this for what stands ...
inline constexpr double kSolverStirredResidual = 1.0e-4;   // ... and this while some body moves in it
inline constexpr double kSolverCrowdResidual = 2.0e-4;     // ... and this of crowds swept alone
inline constexpr int kSolverMostVisits = 50000;  // of a step, where what moves has not come to the coarse one
inline constexpr int kSolverMovingSweeps = 20;   // of what moves, where the budget is less
inline constexpr int kSolverStandingSweeps = 20;       // of what stands, before it is solved at once, and ...
inline constexpr int kSolverCrowdStandingSweeps = 28;  // ... of a crowd that does
// Crowds (focused_solver.h) are swept alone for a pause, to their own residual, when solving them at once
// did not converge, or was too dear, in so many steps more often than not.
inline constexpr long kSolverDearProducts = 16;  // of blocks, a row: more takes longer than the sweeps
inline constexpr int kSolverPatience = 8;
inline constexpr int kSolverPause = 120;  // steps
inline constexpr double kGapGain = 0.2;   // share of a surplus gap closed in a step, where it presses already
inline constexpr double kGapSpeed = 0.1;  // m/s at most while reopening a gap, which is done within a step

// Events of one step and body.
inline constexpr int kPairEvents = 8;      // up to here elastic events are solved between their two bodies
inline constexpr int kEventsPerBody = 24;  // up to here with all that these press; then the body is held
inline constexpr double kLively = 0.75;    // Restitution from which on events die out slowly: ...
inline constexpr int kLivelyShare = 6;     // ... so many times as many.
// Of one step: so many visits of contact rows for every body of the world; then impulses spread no further.
inline constexpr long kVisitsPerBody = 8000;
// Of one step: so many poses are evaluated by the searches for times of impact for every body of the world, a
// second's work for a thousand bodies, and so many at least (0.2 s); then what a look does not clear is
// frozen.
inline constexpr long kSearchWorkPerBody = 5000;
inline constexpr long kLeastSearchWork = 1500000;
inline constexpr int kLateEventsPerBody = 6;  // ... and a body is held after so many events

// Sliding (paper §2.4).
inline constexpr double kSlipSpeed = 1e-5;     // m/s: below it the static coefficient of friction counts
inline constexpr double kSlidingSpeed = 1e-3;  // m/s along the contact; slower is holding or rolling

// Resting mode (paper §2.5).
inline constexpr double kRestSpeed = 0.02;         // m/s of any point: slower counts as lying still
inline constexpr double kRestTime = 0.25;          // s of lying still before the test
inline constexpr double kRestAcceleration = 2e-5;  // of gravity: forces balanced better than this hold a body
inline constexpr int kRestSweeps = 400;            // of the solver in that test, at most, and ...
inline constexpr int kRestRowVisits = 3000000;     // ... more while these last
// Swings about a rest (engine/modes/swinging.h).
inline constexpr double kSwingRise = 2e-3;    // of the radius: a small swing lifts a body by less
inline constexpr double kSwingDamping = 4.0;  // 1/s, more of smaller ones; half of critical at most

}  // namespace carom::tolerance
