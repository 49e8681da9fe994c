#include "engine/foundation/input_file.h"

#include <cerrno>
#include <system_error>

#include "engine/foundation/contract.h"

namespace carom {
namespace {
namespace fs = std::filesystem;

/// What is wrong with a path that is no regular file; empty for one that is.
std::string problemOf(const fs::path& path) {
  std::error_code failed;
  const fs::file_type type = fs::status(path, failed).type();
  switch (type) {
    case fs::file_type::regular:
      return "";
    case fs::file_type::directory:
      return "it is a folder";
    case fs::file_type::fifo:
      return "it is a pipe; accepted: a file";
    case fs::file_type::none:
    case fs::file_type::not_found:
      return failed ? failed.message() : "No such file or directory";
    default:
      return "it is a device or socket; accepted: a file";
  }
}

}  // namespace

InputFile tryInputFile(const fs::path& path) {
  InputFile file{{}, problemOf(path)};
  if (!file.problem.empty()) return file;
  errno = 0;
  file.stream.open(path, std::ios::binary);
  if (file.stream) return file;
  // The file is not at fault where the system has none to give.
  if (errno == EMFILE || errno == ENFILE || errno == ENOMEM)
    throw std::system_error(errno, std::generic_category(), "cannot read '" + path.string() + "'");
  file.problem = std::generic_category().message(errno);
  return file;
}

std::ifstream openInputFile(const fs::path& path) {
  InputFile file = tryInputFile(path);
  if (!file.problem.empty()) throw InputError("cannot read '" + path.string() + "': " + file.problem);
  return std::move(file.stream);
}

}  // namespace carom
