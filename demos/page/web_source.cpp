#include "demos/page/web_source.h"

#include <algorithm>

#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

bool isImport(std::string_view line) {
  return line.starts_with("import ");
}

std::string_view withoutExport(std::string_view line) {
  constexpr std::string_view kExport = "export ";
  if (line.starts_with(kExport)) line.remove_prefix(kExport.size());
  return line;
}

}  // namespace

std::string_view textOf(const std::vector<WebSource>& sources, std::string_view name) {
  for (const WebSource& source : sources)
    if (source.name == name) return source.text;
  REQUIRE(false, std::string(name));
  return {};
}

std::string bundledScript(const std::vector<WebSource>& sources, const std::vector<std::string_view>& names) {
  std::string script;
  for (const std::string_view name : names) {
    const std::string_view text = textOf(sources, name);
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string_view line = text.substr(begin, end - begin);
      if (!isImport(line)) script.append(withoutExport(line)).append("\n");
      begin = end + 1;
    }
  }
  return script;
}

std::string withParts(std::string_view page, const std::vector<PagePart>& parts) {
  std::string whole;
  for (const PagePart& part : parts) {
    const std::size_t at = page.find(part.mark);
    REQUIRE(at != std::string_view::npos, std::string(part.mark));
    whole.append(page.substr(0, at)).append(part.text);
    page.remove_prefix(at + part.mark.size());
    REQUIRE(page.find(part.mark) == std::string_view::npos, std::string(part.mark));
  }
  return whole.append(page);
}

std::string scriptSafe(std::string json) {
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;) json.replace(at, 1, "\\u003c");
  return json;
}

}  // namespace carom::demos
