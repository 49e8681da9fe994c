#include "demos/compare/golden_undo.h"

#include <iterator>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "demos/system/atomic_file.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr char kList[] = "list.json";

void copyWhole(const fs::path& from, const fs::path& to) {
  std::ifstream in = openInputFile(from);
  AtomicFile file(to);
  file.write(std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
  file.commit();
}

void removeAll(const fs::path& path) {
  std::error_code failed;
  fs::remove_all(path, failed);
  if (failed) throw CannotWrite("cannot remove '" + path.string() + "': " + failed.message());
}

Json namesJson(const std::vector<std::string>& names) {
  Json json = Json::array();
  for (const std::string& name : names) json.push(name);
  return json;
}

/// A name in the list, which must lead to below the root.
fs::path within(const fs::path& root, const Json& name) {
  const fs::path relative = fs::path(name.asString()).lexically_normal();
  if (relative.is_absolute() || relative.empty() || relative == "." || *relative.begin() == "..")
    name.fail("is " + name.shown() + "; accepted: a file below the golden folder");
  return root / relative;
}

}  // namespace

void GoldenUndo::keep(const fs::path& file) {
  if (replaced_.empty() && added_.empty()) removeAll(root_ / kUndoFolder);
  const fs::path name = file.lexically_relative(root_);
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    added_.push_back(name.generic_string());
    return;
  }
  copyWhole(file, root_ / kUndoFolder / name);
  replaced_.push_back(name.generic_string());
}

void GoldenUndo::commit() {
  if (replaced_.empty() && added_.empty()) return;
  AtomicFile file(root_ / kUndoFolder / kList);
  file.write(Json::object({{"replaced", namesJson(replaced_)}, {"added", namesJson(added_)}}).text(2) + "\n");
  file.commit();
}

int undoUpdate(const fs::path& root) {
  const fs::path list = root / kUndoFolder / kList;
  std::error_code failed;
  if (!fs::exists(list, failed))
    throw InputError("--undo: no update of '" + root.string() +
                     "' is kept; accepted: once, after --update or --accept");
  const Json json = Json::parse(readTextFile(list), list.string());
  int count = 0;
  for (const Json& name : json.at("replaced").items()) {
    copyWhole(within(root / kUndoFolder, name), within(root, name));
    ++count;
  }
  for (const Json& name : json.at("added").items()) {
    removeAll(within(root, name));
    ++count;
  }
  removeAll(root / kUndoFolder);
  return count;
}

}  // namespace carom::demos
