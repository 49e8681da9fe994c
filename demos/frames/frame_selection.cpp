#include "demos/frames/frame_selection.h"

#include <regex>
#include <set>
#include <sstream>

#include "demos/format/content_hash.h"
#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {

constexpr std::size_t kLongestNamedSelection = 80;  // characters; longer ones are named by their hash

struct Range {
  int first = 0;
  int last = 0;
  int step = 1;
};

[[noreturn]] void refuse(const std::string& text, const std::string& part, int frame_count) {
  throw UsageError("--frames " + text + ": \"" + part + "\": accepted: frames of 0 to " +
                   std::to_string(frame_count - 1) +
                   " and ranges such as 0-9 or 0-30x5, separated by commas");
}

Range readRange(const std::string& text, const std::string& part, int frame_count) {
  static const std::regex form("([0-9]{1,9})(?:-([0-9]{1,9})(?:x([0-9]{1,9}))?)?");
  std::smatch match;
  if (!std::regex_match(part, match, form)) refuse(text, part, frame_count);
  Range range;
  range.first = std::stoi(match[1]);
  range.last = match[2].matched ? std::stoi(match[2]) : range.first;
  range.step = match[3].matched ? std::stoi(match[3]) : 1;
  if (range.last < range.first || range.last >= frame_count || range.step < 1)
    refuse(text, part, frame_count);
  return range;
}

}  // namespace

std::vector<int> selectedFrames(const std::string& text, int frame_count) {
  std::set<int> frames;
  std::istringstream parts(text.empty() ? "0-" + std::to_string(frame_count - 1) : text + ",");
  for (std::string part; std::getline(parts, part, ',');) {
    const Range range = readRange(text, part, frame_count);
    for (long long k = range.first; k <= range.last; k += range.step) frames.insert(static_cast<int>(k));
  }
  return {frames.begin(), frames.end()};
}

Shard readShard(const std::string& text) {
  if (text.empty()) return {};
  static const std::regex form("([0-9]{1,6})/([0-9]{1,6})");
  std::smatch match;
  Shard shard;
  const bool read = std::regex_match(text, match, form);
  if (read) shard = {std::stoi(match[1]), std::stoi(match[2])};
  if (!read || shard.index < 1 || shard.index > shard.count)
    throw UsageError("--shard " + text + ": accepted: i/n with i from 1 to n, such as 3/8");
  return shard;
}

std::vector<int> shardOf(const std::vector<int>& frames, const Shard& shard) {
  std::vector<int> mine;
  const auto stride = static_cast<std::size_t>(shard.count);
  for (auto i = static_cast<std::size_t>(shard.index - 1); i < frames.size(); i += stride)
    mine.push_back(frames[i]);
  return mine;
}

std::string manifestName(const std::string& frames, const std::string& shard) {
  std::string name = "manifest";
  if (!frames.empty())
    name += ".frames-" +
            (frames.size() <= kLongestNamedSelection ? frames : hexText(ContentHash().add(frames).value()));
  if (!shard.empty()) {
    const Shard part = readShard(shard);
    name += ".shard-" + std::to_string(part.index) + "-of-" + std::to_string(part.count);
  }
  return name + ".json";
}

}  // namespace carom::demos
