#include "demos/asset/mesh_header.h"

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "engine/foundation/contract.h"

namespace carom::demos {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLongestHead = 1 << 20;
constexpr std::size_t kOffName = 10;  // letters that may say what else each vertex has, and then OFF
constexpr std::size_t kShown = 60;    // letters of a head in a message
// What is written of each at least: three digits with what parts them; the number of corners likewise.
constexpr double kOffVertexBytes = 6, kOffFaceBytes = 2;

std::string headOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(kLongestHead, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": cannot be read as a mesh: " + what);
}

[[noreturn]] void refuseCounts(const fs::path& path, const std::string& counts, std::uintmax_t size) {
  refuse(path, "it claims " + counts + ", but has " + std::to_string(size) + " bytes");
}

void requirePlyCounts(const fs::path& path, const std::string& head, std::uintmax_t size) {
  std::istringstream lines(head);
  double elements = 0.0;
  for (std::string line; std::getline(lines, line);) {
    // assimp goes on for ever where something else follows.
    constexpr std::string_view kEnd = "end_header";
    if (line.rfind(kEnd, 0) == 0 && line.find_first_not_of(" \t\r", kEnd.size()) == std::string::npos) return;
    std::istringstream words(line);
    std::string keyword, name;
    double count = 0.0;
    if (!(words >> keyword >> name >> count) || keyword != "element") continue;
    elements += count;  // each is at least a byte
    if (!(elements <= static_cast<double>(size))) refuseCounts(path, line.substr(0, kShown), size);
  }
  refuse(path, "the PLY header has no end_header");
}

[[noreturn]] void refuseOffCounts(const fs::path& path, const std::string& counts, std::uintmax_t size) {
  std::istringstream words(counts);
  std::string vertices, faces;
  words >> vertices >> faces;
  refuseCounts(path, vertices.substr(0, kShown) + " vertices and " + faces.substr(0, kShown) + " faces",
               size);
}

void requireOffCounts(const fs::path& path, const std::string& head, std::uintmax_t size) {
  std::istringstream lines(head.substr(head.find("OFF") + 3));
  std::string counts;
  for (std::string line; std::getline(lines, line);) {
    counts.append(" ").append(line, 0, line.find('#'));
    std::istringstream words(counts);
    double vertices = 0.0, faces = 0.0;
    if (!(words >> vertices >> faces)) continue;
    if (!(kOffVertexBytes * vertices + kOffFaceBytes * faces <= static_cast<double>(size)))
      refuseOffCounts(path, counts, size);
    return;
  }
}

}  // namespace

void requireSoundHeader(const fs::path& path) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  if (failed) return;  // its reader says why
  const std::string head = headOf(path);
  const std::string_view first = std::string_view(head).substr(0, head.find('\n'));
  if (first.rfind("ply", 0) == 0) return requirePlyCounts(path, head, size);
  if (first.substr(0, kOffName).find("OFF") != std::string_view::npos) requireOffCounts(path, head, size);
}

}  // namespace carom::demos
