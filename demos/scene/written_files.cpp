#include "demos/scene/written_files.h"

#include <map>

#include <sys/stat.h>

#include "demos/asset/mesh_companions.h"
#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

/// The same text for all paths to one file: its device and number, or where it would be. Nothing for a device
/// or pipe.
std::optional<std::string> identityOf(const fs::path& path) {
  if (path == kStandardOutput) return kStandardOutput;
  struct stat found {};
  if (::stat(path.c_str(), &found) == 0) {
    if (!S_ISREG(found.st_mode) && !S_ISDIR(found.st_mode)) return std::nullopt;
    return std::to_string(found.st_dev) + ':' + std::to_string(found.st_ino);
  }
  std::error_code unknown;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, unknown), unknown);
  return '/' + (unknown ? path : whole).string();
}

/// "--csv x.csv"
std::string asGiven(const NamedFile& file) {
  return file.name + ' ' + file.file.string();
}

void addFile(const std::string& name, const fs::path& file, std::vector<NamedFile>& files) {
  if (file.empty()) return;
  files.push_back({name, file});
  for (const fs::path& other : filesNamedBy(file)) files.push_back({name, other});
}

void addMeshes(const Shape& shape, std::vector<NamedFile>& files) {
  if (const auto* hull = std::get_if<HullShape>(&shape.form)) {
    addFile("the scene", hull->file, files);
  } else if (const auto* compound = std::get_if<CompoundShape>(&shape.form)) {
    for (const CompoundPart& part : compound->parts) addMeshes(part.shape, files);
  }
}

}  // namespace

void requireDistinct(std::span<const NamedFile> written) {
  std::map<std::string, const NamedFile*> known;
  for (const NamedFile& file : written) {
    const std::optional<std::string> identity = identityOf(file.file);
    if (!identity) continue;
    const auto [at, is_new] = known.try_emplace(*identity, &file);
    if (!is_new)
      throw UsageError(asGiven(file) + ": given twice, " + at->second->name +
                       " is written there; accepted: another file for each");
  }
}

void requireNotRead(std::span<const NamedFile> written, std::span<const NamedFile> read) {
  if (written.empty()) return;
  std::map<std::string, const NamedFile*> known;
  for (const NamedFile& file : read)
    if (const std::optional<std::string> identity = identityOf(file.file)) known.emplace(*identity, &file);
  for (const NamedFile& file : written) {
    const std::optional<std::string> identity = identityOf(file.file);
    const auto at = identity ? known.find(*identity) : known.end();
    if (at != known.end())
      throw UsageError(asGiven(file) + ": " + at->second->name +
                       " is read from there; accepted: another file");
  }
}

std::vector<NamedFile> filesOf(const Scene& scene, const std::optional<fs::path>& mesh) {
  std::vector<NamedFile> files = {{"the scene", scene.file}};
  for (const fs::path& file : scene.included) files.push_back({"the scene", file});
  for (const Body& body : scene.bodies) {
    addMeshes(body.shape, files);
    if (body.visual) addFile("the scene", body.visual->file, files);
  }
  if (mesh) addFile("--mesh", *mesh, files);
  return files;
}

}  // namespace carom::demos
