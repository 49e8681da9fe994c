#pragma once
// Which frames of a run are drawn: "0-99,150,200-300x5" and a shard "3/8" of those. The split depends on
// nothing but the selection, so that shards on many machines need not know of each other. Tested in
// tests/demos/frames/frame_selection_test.cpp.

#include <string>
#include <vector>

namespace carom::demos {

/// The frames of a list of frames and ranges FIRST-LAST or FIRST-LASTxSTEP, ascending, each once; all of
/// [0, frame_count) for an empty text. Throws UsageError for anything else and for a frame that is not there.
std::vector<int> selectedFrames(const std::string& text, int frame_count);

/// Shard `index` of `count`, counted from 1.
struct Shard {
  int index = 1;
  int count = 1;
};
/// Reads "i/n"; the whole for an empty text. Throws UsageError.
Shard readShard(const std::string& text);

/// The frames at places index - 1, index - 1 + count, ...: shards are disjoint, cover everything, and share
/// out slow stretches evenly. Empty when there are fewer frames than shards.
std::vector<int> shardOf(const std::vector<int>& frames, const Shard& shard);

/// "manifest.json" of a whole run; a part's own name, such as "manifest.frames-0-99.shard-3-of-8.json", so
/// that parts that run at once never write over each other's manifest.
std::string manifestName(const std::string& frames, const std::string& shard);

}  // namespace carom::demos
