#pragma once
// All mistakes of a scene at once: what is refused is taken out, or replaced where nothing can be without it,
// and the rest is read again. Tested in tests/demos/language/scene_mistakes_test.cpp.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "demos/format/json.h"

namespace carom::demos {

/// Each mistake with its remedy, in the order of the file, given the first; at most `most`, for `read`, which
/// throws the first of those that are left, reads the scene again for each. Never empty.
std::vector<std::string> mistakesOf(Json json, const std::filesystem::path& path, JsonError first, int most,
                                    const std::function<void(const Json&)>& read);

}  // namespace carom::demos
