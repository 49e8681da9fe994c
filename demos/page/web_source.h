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

/// What a page is to hold in place of a mark, such as "<!--NAME-->" or "/*NAME*/".
struct PagePart {
  std::string_view mark;
  std::string text;
};

/// `page` with its parts, which are in the order of their marks; each mark must be in it once. A part may
/// hold what looks like a mark.
std::string withParts(std::string_view page, const std::vector<PagePart>& parts);

/// JSON that may stand in a script element: no "</" or "<!--" is left in it.
std::string scriptSafe(std::string json);

/// The player's files.
const std::vector<WebSource>& playerSources();

}  // namespace carom::demos
