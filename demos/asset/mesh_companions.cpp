#include "demos/asset/mesh_companions.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <system_error>

#include "demos/asset/asset_path.h"

namespace carom::demos {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostFiles = 256;

void addIfThere(const fs::path& folder, std::string name, std::vector<fs::path>& files) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path path = folder / name;
  std::error_code ignored;
  if (name.empty() || files.size() >= kMostFiles || !fs::is_regular_file(path, ignored)) return;
  if (std::find(files.begin(), files.end(), path) == files.end()) files.push_back(path);
}

/// What follows one of the words at the beginning of a line: all of it, or of a map its last word.
void addNamed(const fs::path& file, const std::string& begin, bool last_word, std::vector<fs::path>& files) {
  std::istringstream text(readTextFile(file));
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string word, rest;
    if (!(words >> word) || !word.starts_with(begin)) continue;
    std::getline(words >> std::ws, rest);
    while (!rest.empty() && (rest.back() == '\r' || rest.back() == ' ')) rest.pop_back();
    if (last_word && rest.starts_with('-')) rest = rest.substr(rest.find_last_of(" \t") + 1);
    addIfThere(file.parent_path(), rest, files);
  }
}

/// Each "uri": "..." of a glTF file.
void addUris(const fs::path& file, std::vector<fs::path>& files) {
  const std::string text = readTextFile(file);
  for (std::size_t at = text.find("\"uri\""); at != std::string::npos; at = text.find("\"uri\"", at + 1)) {
    const std::size_t colon = text.find(':', at), open = text.find('"', colon);
    if (colon == std::string::npos || open == std::string::npos) return;
    const std::size_t close = text.find('"', open + 1);
    if (close == std::string::npos) return;
    const std::string uri = text.substr(open + 1, std::min<std::size_t>(close - open - 1, 4096));
    if (!uri.starts_with("data:")) addIfThere(file.parent_path(), uri, files);
  }
}

}  // namespace

std::vector<fs::path> filesNamedBy(const fs::path& mesh) {
  std::vector<fs::path> files;
  if (mesh.extension() == ".gltf") addUris(mesh, files);
  if (mesh.extension() != ".obj") return files;
  addNamed(mesh, "mtllib", false, files);
  const std::vector<fs::path> libraries = files;
  for (const fs::path& library : libraries) addNamed(library, "map_K", true, files);
  return files;
}

}  // namespace carom::demos
