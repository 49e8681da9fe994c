#pragma once
// Since when, where and by how much two records of one scene move differently. Tested in
// tests/demos/compare/cause_test.cpp.

#include <string>
#include <vector>

#include "demos/cause/cause_facts.h"
#include "demos/cause/motion_record.h"
#include "demos/cause/picture_evidence.h"

namespace carom::demos {

/// The first step after which the states differ, of those of which both have a print; -1: none, or not known.
int firstDifferentStep(const MotionRecord& actual, const MotionRecord& golden);

/// The first collision or contact up to a time that is not as it was, as a line; empty: there is none.
std::string firstEvent(const MotionRecord& actual, const MotionRecord& golden, double until_s);

/// Farthest first; the first few with their tracks.
std::vector<MovedBody> movedBodies(const RecordedPicture& actual, const RecordedPicture& golden);

}  // namespace carom::demos
