#pragma once
// Which files of two folders belong together: PNG files of the same relative path, sub-folders included, in
// the order of their names. Tested in tests/demos/compare/image_pairs_test.cpp.

#include <filesystem>
#include <string>
#include <vector>

namespace carom::demos {

struct ImagePair {
  std::string name;              ///< Relative to the folders, with forward slashes.
  std::filesystem::path actual;  ///< Where each is, or would be.
  std::filesystem::path golden;
  bool has_actual = false;
  bool has_golden = false;
};

/// Other images that are accepted in the place of this one: the PNG files of the folder "frame_0001.variants"
/// beside "frame_0001.png", by name. Such folders hold no pairs.
std::vector<std::filesystem::path> goldenVariants(const std::filesystem::path& golden);

/// What is to be compared with what; both files or both folders.
struct ComparedPaths {
  std::filesystem::path actual;
  std::filesystem::path golden;
  bool golden_may_be_missing = false;  ///< It is about to be written.
};

/// Every pair in the byte order of the names. Two files are one pair, named as the golden one. Throws
/// InputError for a path that is not there and for folders without a single PNG file (comparing nothing is no
/// success), and UsageError for a file against a folder.
std::vector<ImagePair> imagePairs(const ComparedPaths& paths);

}  // namespace carom::demos
