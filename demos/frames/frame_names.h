#pragma once
// The names of frame files: one pattern with the frame's number written as %04d or ####.
// Tested in tests/demos/frames/frame_names_test.cpp.

#include <filesystem>
#include <string>

namespace carom::demos {

class FrameNames {
 public:
  /// Throws UsageError for a pattern without exactly one number in its file name, or that does not end in
  /// .png.
  explicit FrameNames(const std::string& pattern);

  /// The name of a single picture, whatever its frame. Throws UsageError when it does not end in .png.
  static FrameNames still(const std::string& path);

  std::filesystem::path file(int frame) const;
  /// That of a frame's other output: "frame_0007.depth.png" beside "frame_0007.png".
  std::filesystem::path file(int frame, const std::string& output) const;
  std::filesystem::path folder() const { return folder_; }
  const std::string& pattern() const { return pattern_; }

 private:
  FrameNames() = default;

  std::string pattern_;
  std::filesystem::path folder_;
  std::string before_, after_;  // the file's name around its number
  bool is_still_ = false;
  std::size_t digits_ = 0;  // padded with zeros to at least this many
};

}  // namespace carom::demos
