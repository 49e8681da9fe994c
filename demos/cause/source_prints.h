#pragma once
// The sources that this program was built from, each with a print of its text without comments and spaces:
// what tells a changed shader or solver from a changed scene. Written at build time by source_prints.cmake.

#include "demos/cause/motion_record.h"

namespace carom::demos {

/// "renderer/passes/surface_pass.cpp" and eight hexadecimal digits, by name.
const Facts& sourcePrints();

}  // namespace carom::demos
