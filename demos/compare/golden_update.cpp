#include "demos/compare/golden_update.h"

#include <iterator>

#include "demos/cause/motion_record.h"
#include "demos/system/atomic_file.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"

namespace carom::demos {
namespace {

std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream in = openInputFile(path);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return in ? bytes : "";
}

void copyWhole(const std::filesystem::path& from, const std::filesystem::path& to) {
  const std::string bytes = bytesOf(from);
  if (bytes.empty()) throw InputError("cannot read '" + from.string() + "': it has changed meanwhile");
  AtomicFile file(to);
  file.write(bytes);
  file.commit();
}

}  // namespace

Update plannedUpdate(const Comparison& comparison) {
  if (comparison.passes()) return Update::kNone;
  if (!comparison.actual_shape) return Update::kRefused;
  return comparison.pair.has_golden ? Update::kReplaced : Update::kAdded;
}

bool writesGolden(Update update) {
  return update == Update::kReplaced || update == Update::kAdded;
}

void replaceGolden(const ImagePair& pair) {
  copyWhole(pair.actual, pair.golden);
}

bool hasOtherRecord(const ImagePair& pair) {
  const std::filesystem::path actual = pair.actual.parent_path() / kRecordName;
  const std::filesystem::path golden = pair.golden.parent_path() / kRecordName;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(actual, ignored)) return false;
  return !std::filesystem::is_regular_file(golden, ignored) || bytesOf(actual) != bytesOf(golden);
}

void updateRecord(const ImagePair& pair) {
  copyWhole(pair.actual.parent_path() / kRecordName, pair.golden.parent_path() / kRecordName);
}

const char* updateName(Update update) {
  switch (update) {
    case Update::kNone:
      return "";
    case Update::kReplaced:
      return "replaced";
    case Update::kAdded:
      return "added";
    case Update::kRefused:
      return "kept";
  }
  return "";
}

}  // namespace carom::demos
