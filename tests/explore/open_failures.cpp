#include "tests/explore/open_failures.h"

#include <sstream>

#include "demos/asset/asset_path.h"
#include "engine/foundation/contract.h"

namespace carom::explore {

std::vector<OpenFailure> parseOpenFailures(std::string_view text, const std::string& origin) {
  std::vector<OpenFailure> open;
  std::istringstream in{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    OpenFailure failure;
    std::istringstream words(line);
    std::string hash;
    if (!(words >> failure.kind >> failure.family >> failure.most >> hash) || hash != "#" ||
        !std::getline(words >> std::ws, failure.cause))
      throw InputError(origin + ":" + std::to_string(number) + ": \"" + line +
                       "\"; accepted: <kind> <family or *> <largest figure> # <cause>");
    open.push_back(failure);
  }
  return open;
}

std::vector<OpenFailure> readOpenFailures(const std::filesystem::path& path) {
  return parseOpenFailures(demos::readTextFile(path), path.string());
}

}  // namespace carom::explore
