#pragma once
// The files of a folder web/ as the build put them into the program (demos/page/embed_web.cmake): pages,
// styles, scripts and shaders are written as such and lie in no folder when the program runs. Tested in
// tests/demos/page/player_page_test.cpp.

#include <string>
#include <string_view>
#include <vector>

namespace carom::demos {

struct WebSource {
  std::string_view name;  ///< "player.css"
  std::string_view text;
};

/// The text of the file of that name, which must be one of them.
std::string_view textOf(const std::vector<WebSource>& sources, std::string_view name);

/// Modules in one script: their imports are left out and their exports are plain names, which must differ.
/// `names` are in the order of use, what is imported first.
std::string bundledScript(const std::vector<WebSource>& sources, const std::vector<std::string_view>& names);

/// `page` with `text` in place of "<!--NAME-->" (or "/*NAME*/"), which must be in it once.
std::string withPart(std::string page, std::string_view mark, std::string_view text);

/// JSON that may stand in a script element: no "</" or "<!--" is left in it.
std::string scriptSafe(std::string json);

/// The player's files.
const std::vector<WebSource>& playerSources();

}  // namespace carom::demos
