#include "demos/frame_names.h"

#include <regex>

#include "demos/exit_code.h"

namespace carom::demos {

FrameNames::FrameNames(const std::string& pattern) : pattern_(pattern) {
  const std::filesystem::path path(pattern);
  const std::string name = path.filename().string();
  static const std::regex number("%(?:0([1-9]))?d|#+");
  std::smatch match;
  const bool found = std::regex_search(name, match, number);
  const std::string rest = found ? match.suffix().str() : "";
  const bool once = found && !std::regex_search(rest, number) &&
                    (match.prefix().str() + rest).find('%') == std::string::npos;
  if (!once || path.extension() != ".png")
    throw UsageError(
        "-o " + pattern +
        ": accepted: a .png name with one frame number as %04d or ####, such as out/frame_%04d.png");
  folder_ = path.parent_path();
  before_ = match.prefix().str();
  after_ = rest;
  digits_ = name[before_.size()] == '#' ? static_cast<std::size_t>(match[0].length())
            : match[1].matched          ? static_cast<std::size_t>(match[1].str()[0] - '0')
                                        : 1;
}

std::filesystem::path FrameNames::file(int frame) const {
  std::string number = std::to_string(frame);
  if (number.size() < digits_) number.insert(0, digits_ - number.size(), '0');
  return folder_ / (before_ + number + after_);
}

}  // namespace carom::demos
