#pragma once
// All mistakes of a scene at once: what is refused is taken out, or replaced where nothing can be without it,
// and the rest is read again. Tested in tests/demos/language/scene_mistakes_test.cpp.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "demos/format/json.h"

namespace carom::demos {

struct Mistakes {
  std::string first;             ///< That was met: what stands in no placeholder and follows from no other.
  std::vector<std::string> all;  ///< In the order of the file; never empty.
};
/// Each mistake with its remedy, given the first; at most `most`, for `read`, which throws the first of those
/// that are left, reads the scene again for each.
Mistakes mistakesOf(Json json, const std::filesystem::path& path, JsonError first, int most,
                    const std::function<void(const Json&)>& read);

}  // namespace carom::demos
