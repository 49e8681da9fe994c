#pragma once
// The outcome of a suite: one page over all scenes, worst first, that opens from disk and leads to each
// report; JSON and JUnit. Tested in tests/demos/program/regress_program_test.cpp.

#include <string>
#include <vector>

#include "demos/regress/regress_run.h"

namespace carom::demos {

/// "29 of 31 scenes pass, 1 differs, 1 could not be drawn"
std::string suiteSummary(const std::vector<SceneOutcome>& outcomes);
/// What is to be said of a scene: the cause of its worst pair, or what went wrong; empty where it passes.
std::string sceneLine(const SceneOutcome& outcome);
std::string indexPage(const std::vector<SceneOutcome>& outcomes, const std::string& suite);
Json suiteJson(const std::vector<SceneOutcome>& outcomes);
std::string suiteJunit(const std::vector<SceneOutcome>& outcomes);

}  // namespace carom::demos
