#include "demos/compare/image_pairs.h"

#include <algorithm>
#include <map>

#include "demos/compare/golden_undo.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr char kVariants[] = ".variants";

enum class Kind { kNothing, kFile, kFolder };

Kind kindOf(const fs::path& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (status.type() == fs::file_type::not_found) return Kind::kNothing;
  if (failed) throw InputError("cannot read '" + path.string() + "': " + failed.message());
  return fs::is_directory(status) ? Kind::kFolder : Kind::kFile;
}

bool isPng(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension == ".png";
}

bool holdsNoPairs(const fs::path& folder) {
  return folder.filename() == kUndoFolder || folder.extension() == kVariants;
}

/// Whether a folder is a link to one that it is in: there is nothing new below it.
bool leadsBack(const fs::directory_entry& entry) {
  std::error_code unknown;
  if (!entry.is_symlink(unknown)) return false;
  const fs::path to = fs::canonical(entry.path(), unknown);
  const fs::path in = fs::canonical(entry.path().parent_path(), unknown);
  return !unknown && std::mismatch(to.begin(), to.end(), in.begin(), in.end()).first == to.end();
}

/// The relative names of the PNG files below a folder; none when there is no folder.
std::vector<std::string> pngNames(const fs::path& folder, Kind kind) {
  std::vector<std::string> names;
  if (kind == Kind::kNothing) return names;
  std::error_code failed;
  fs::recursive_directory_iterator entries(folder, fs::directory_options::follow_directory_symlink, failed);
  // What is no folder is a pair's, even a link that leads nowhere, which is that pair's failure alone.
  std::error_code unknown;
  for (; !failed && entries != fs::recursive_directory_iterator(); entries.increment(failed)) {
    if (entries->is_directory(unknown) && (holdsNoPairs(entries->path()) || leadsBack(*entries)))
      entries.disable_recursion_pending();
    if (isPng(entries->path()) && !entries->is_directory(unknown))
      names.push_back(entries->path().lexically_relative(folder).generic_string());
  }
  if (failed) throw InputError("cannot read '" + folder.string() + "': " + failed.message());
  return names;
}

void requireExisting(const fs::path& path, Kind kind) {
  if (kind == Kind::kNothing)
    throw InputError("cannot read '" + path.string() +
                     "': no such file or folder; accepted: a PNG file or a "
                     "folder of them");
}

std::vector<ImagePair> folderPairs(const ComparedPaths& paths, Kind golden_kind) {
  std::map<std::string, ImagePair> pairs;
  for (const std::string& name : pngNames(paths.actual, Kind::kFolder)) pairs[name].has_actual = true;
  for (const std::string& name : pngNames(paths.golden, golden_kind)) pairs[name].has_golden = true;
  if (pairs.empty())
    throw InputError("nothing to compare: no PNG file in '" + paths.actual.string() + "' or '" +
                     paths.golden.string() + "'");
  std::vector<ImagePair> sorted;
  for (auto& [name, pair] : pairs) {
    pair.name = name;
    pair.actual = paths.actual / name;
    pair.golden = paths.golden / name;
    sorted.push_back(std::move(pair));
  }
  return sorted;
}

}  // namespace

std::vector<fs::path> goldenVariants(const fs::path& golden) {
  const fs::path folder = golden.parent_path() / (golden.stem().string() + kVariants);
  std::vector<fs::path> variants;
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed))
    if (isPng(entry.path())) variants.push_back(entry.path());
  std::sort(variants.begin(), variants.end());
  return variants;
}

std::vector<ImagePair> imagePairs(const ComparedPaths& paths) {
  const Kind actual = kindOf(paths.actual);
  const Kind golden = kindOf(paths.golden);
  requireExisting(paths.actual, actual);
  if (!paths.golden_may_be_missing) requireExisting(paths.golden, golden);
  if (golden != Kind::kNothing && golden != actual)
    throw UsageError("compare: '" + paths.actual.string() + "' and '" + paths.golden.string() +
                     "' are a file and a folder; accepted: two files or two folders");
  if (actual == Kind::kFolder) return folderPairs(paths, golden);
  return {{paths.golden.filename().string(), paths.actual, paths.golden, true, golden == Kind::kFile}};
}

}  // namespace carom::demos
