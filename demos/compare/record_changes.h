#pragma once
// What differs between two records in the world, in the look and in the program, in words. Tested in
// tests/demos/compare/cause_test.cpp.

#include <string>
#include <vector>

#include "demos/cause/cause_facts.h"
#include "demos/cause/motion_record.h"
#include "demos/cause/picture_evidence.h"

namespace carom::demos {

inline constexpr std::size_t kMostNamed = 3;  ///< Bodies, or changes, in one line.

/// What differs between two records, in the order in which it is to be suspected.
struct Differences {
  std::vector<Change> world;  ///< What the motion follows from.
  std::vector<Change> look;   ///< What the picture of a motion follows from.
};
Differences differencesOf(const RecordedPicture& actual, const RecordedPicture& golden);

/// Of the program: those sources that the engine is made of, or all others.
std::vector<Change> changedSources(const MotionRecord& actual, const MotionRecord& golden, bool of_engine);

}  // namespace carom::demos
