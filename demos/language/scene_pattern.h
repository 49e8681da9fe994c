#pragma once
// "repeat" of a body: where its copies stand and how they are turned. A lattice ("count" and "step"), or one
// of row, circle, arc, spiral, stack and random, all around the body's own position; each may be turned more
// than the one before and moved a little by chance. The same file gives the same bits everywhere. Tested in
// tests/demos/language/scene_expansion_test.cpp.

#include <string>
#include <vector>

#include "demos/format/json.h"
#include "demos/scene/scene.h"

namespace carom::demos {

/// `warnings` takes what is said but has no effect. Throws InputError.
Repeat readRepeat(const Json& json, std::vector<std::string>& warnings);

/// The farthest copy must be as near as any other body. Throws InputError.
void requireWithinReach(const Json& json, const Body& body);

}  // namespace carom::demos
