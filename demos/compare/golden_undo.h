#pragma once
// What an update of golden files replaced, kept beside them until the next one (.carom-undo), so that it can
// be taken back. Tested in tests/demos/compare/golden_undo_test.cpp.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace carom::demos {

/// Folders of this name hold no golden images.
inline constexpr char kUndoFolder[] = ".carom-undo";

class GoldenUndo {
 public:
  /// Of the golden files below `root`.
  explicit GoldenUndo(std::filesystem::path root) : root_(std::move(root)) {}
  /// To be called before `file` is written or added. The first one forgets the update before: one that
  /// changes nothing leaves it.
  void keep(const std::filesystem::path& file);
  /// From now on the update can be taken back; called once all is kept, and before any file is written.
  void commit();

 private:
  std::filesystem::path root_;
  std::vector<std::string> replaced_, added_;
};

/// Puts back what the last update below `root` replaced and removes what it added; how many files these are.
/// Throws InputError where there is nothing to take back, CannotWrite.
int undoUpdate(const std::filesystem::path& root);

}  // namespace carom::demos
