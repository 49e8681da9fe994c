#include "demos/gallery/gallery_entry.h"

#include <algorithm>
#include <cstdlib>

#include "demos/asset/asset_path.h"
#include "demos/cause/source_prints.h"
#include "demos/format/content_hash.h"
#include "demos/page/web_source.h"
#include "demos/scene/scene_world.h"
#include "demos/system/build_info.h"

namespace carom::demos {

Json GalleryEntry::json() const {
  Json list = Json::array();
  for (const GalleryFile& file : files)
    list.push(Json::object(
        {{"name", file.name}, {"hash", hexText(file.hash)}, {"bytes", static_cast<double>(file.bytes)}}));
  return Json::object({{"name", name},
                       {"identity", identity},
                       {"group", group},
                       {"description", description},
                       {"lookFor", look_for},
                       {"command", command},
                       {"bodies", bodies},
                       {"duration_s", duration_s},
                       {"width", width},
                       {"height", height},
                       {"files", std::move(list)}});
}

GalleryEntry galleryEntry(const Json& json) {
  GalleryEntry entry;
  entry.name = json.at("name").asString();
  entry.identity = json.at("identity").asString();
  entry.group = json.at("group").asString();
  entry.description = json.at("description").asString();
  entry.look_for = json.at("lookFor").asString();
  entry.command = json.at("command").asString();
  entry.bodies = static_cast<int>(json.at("bodies").asNumber());
  entry.duration_s = json.at("duration_s").asNumber();
  entry.width = static_cast<int>(json.at("width").asNumber());
  entry.height = static_cast<int>(json.at("height").asNumber());
  for (const Json& file : json.at("files").items())
    entry.files.push_back({file.at("name").asString(),
                           std::strtoull(file.at("hash").asString().c_str(), nullptr, 16),
                           static_cast<std::int64_t>(file.at("bytes").asNumber())});
  return entry;
}

std::string galleryPage(const std::string& scene) {
  return "scenes/" + scene + ".html";
}
std::string galleryPicture(const std::string& scene) {
  return "pictures/" + scene + ".png";
}
std::string galleryStill(const std::string& scene) {
  return "pictures/" + scene + ".still.png";
}

std::string galleryIdentity(const Scene& scene, const GalleryShape& shape) {
  ContentHash hash;
  hash.add(hexText(sceneHash(scene, std::nullopt)));
  hash.add(programVersion());
  for (const auto& [source, print] : sourcePrints()) {
    hash.add(source);
    hash.add(print);
  }
  for (const WebSource& source : playerSources()) hash.add(std::string(source.text));
  hash.add(std::to_string(shape.width) + "x" + std::to_string(shape.height) + " at " +
           std::to_string(shape.fps));
  return hexText(hash.value());
}

namespace {

/// Whether it is there as it was written, in the gallery itself.
bool isAsWritten(const GalleryFile& file, const std::filesystem::path& folder) {
  const std::filesystem::path name = std::filesystem::path(file.name).lexically_normal();
  if (name.empty() || name.is_absolute() || *name.begin() == "..") return false;
  std::error_code failed;
  const std::filesystem::path path = folder / name;
  if (static_cast<std::int64_t>(std::filesystem::file_size(path, failed)) != file.bytes || failed)
    return false;
  ContentHash hash;
  hash.add(readTextFile(path));
  return hash.value() == file.hash;
}

}  // namespace

bool isWhole(const GalleryEntry& entry, const std::filesystem::path& folder) {
  return !entry.files.empty() && std::all_of(entry.files.begin(), entry.files.end(),
                                             [&](const GalleryFile& f) { return isAsWritten(f, folder); });
}

void removeFiles(const GalleryEntry& entry, const std::filesystem::path& folder) {
  for (const GalleryFile& file : entry.files) {
    std::error_code ignored;
    if (isAsWritten(file, folder)) std::filesystem::remove(folder / file.name, ignored);
  }
}

}  // namespace carom::demos
