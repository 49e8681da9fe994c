#include "demos/frames/frame_names.h"

#include <regex>

#include "demos/system/exit_code.h"

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
        ": accepted: a .png name with one frame number as %04d or ####, such as out/frame_%04d.png; one "
        "picture is out/still.png with --at SECONDS, a moving one ends in .apng, .gif, .webp or .mp4");
  folder_ = path.parent_path();
  before_ = match.prefix().str();
  after_ = rest;
  digits_ = name[before_.size()] == '#' ? static_cast<std::size_t>(match[0].length())
            : match[1].matched          ? static_cast<std::size_t>(match[1].str()[0] - '0')
                                        : 1;
}

FrameNames FrameNames::still(const std::string& path) {
  FrameNames names;
  names.pattern_ = path;
  names.folder_ = std::filesystem::path(path).parent_path();
  names.before_ = std::filesystem::path(path).filename().string();
  if (std::filesystem::path(path).extension() != ".png")
    throw UsageError("-o " + path + ": accepted with --at: a name that ends in .png, such as still.png");
  names.before_.resize(names.before_.size() - 4);
  names.after_ = ".png";
  names.is_still_ = true;
  return names;
}

std::filesystem::path FrameNames::file(int frame, const std::string& output) const {
  std::filesystem::path path = file(frame);
  return path.replace_extension(output + ".png");
}

std::filesystem::path FrameNames::file(int frame) const {
  if (is_still_) return folder_ / (before_ + after_);
  std::string number = std::to_string(frame);
  if (number.size() < digits_) number.insert(0, digits_ - number.size(), '0');
  return folder_ / (before_ + number + after_);
}

}  // namespace carom::demos
