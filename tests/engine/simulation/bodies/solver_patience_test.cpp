// When an island of thousands of contacts is no longer solved at once, and when it is again.

#include "engine/simulation/bodies/solver_patience.h"

#include <gtest/gtest.h>

#include "engine/foundation/tolerances.h"
#include "engine/response/focused_solver.h"

namespace carom {
namespace {

// A body on the ground (body 0, static) by so many rows.
struct Island {
  std::vector<Body> bodies{2};
  std::vector<ContactRow> rows;

  explicit Island(std::size_t count) : rows(count) {
    bodies[0].is_static = true;
    for (ContactRow& row : rows) {
      row.a = 0;
      row.b = 1;
    }
  }
  bool isLost() { return SolverPatience(rows, bodies).isLost(); }
  void learn(bool converged, long products = 1) {
    const SolverReport report{.residual_mps = converged ? 0.5 : 2.0, .products = products};
    SolverPatience(rows, bodies).learn(report, 1.0);
  }
  /// Steps until it is tried again.
  int waitToTheEnd() {
    int steps = 0;
    for (; isLost(); ++steps) SolverPatience(rows, bodies).waitAStep();
    return steps;
  }
};

TEST(SolverPatience, OfALargeIslandIsLostAfterSomeStepsInVain_AndThenAtOnce) {
  Island island(kFocusedRows);
  for (int i = 0; i < tolerance::kSolverPatience; ++i) {
    EXPECT_FALSE(island.isLost()) << i;
    island.learn(false);
  }
  EXPECT_EQ(island.waitToTheEnd(), tolerance::kSolverPause);
  island.learn(false);
  EXPECT_EQ(island.waitToTheEnd(), tolerance::kSolverPause);
  EXPECT_EQ(island.bodies[0].in_vain, 0) << "what does not move belongs to many islands";
}

TEST(SolverPatience, ComesBackWithStepsThatConverge) {
  Island island(kFocusedRows);
  for (int i = 0; i < tolerance::kSolverPatience; ++i) island.learn(false);
  island.waitToTheEnd();
  for (int i = 0; i < 3; ++i) island.learn(true);
  for (int i = 0; i < 3; ++i) {
    island.learn(false);
    EXPECT_FALSE(island.isLost()) << i;
  }
  island.learn(false);
  EXPECT_TRUE(island.isLost());
}

TEST(SolverPatience, WhatSweepsSolveTeachesNothing) {
  Island island(kFocusedRows);
  for (int i = 0; i + 1 < tolerance::kSolverPatience; ++i) island.learn(false);
  for (int i = 0; i < 100; ++i) island.learn(false, 0);
  EXPECT_FALSE(island.isLost());
  for (int i = 0; i < 100; ++i) island.learn(true, 0);
  island.learn(false);
  EXPECT_TRUE(island.isLost());
}

TEST(SolverPatience, OfASmallIslandIsNeverLost) {
  Island island(kFocusedRows - 1);
  for (int i = 0; i < 100; ++i) island.learn(false);
  EXPECT_FALSE(island.isLost());
}

}  // namespace
}  // namespace carom
