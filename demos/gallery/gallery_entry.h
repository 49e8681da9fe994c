#pragma once
// What a gallery knows of one of its scenes, and what the scene's files follow from. Kept in gallery.json, so
// that a scene that is as it was is not made again. Tested in tests/demos/gallery/gallery_entry_test.cpp.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "demos/format/json.h"
#include "demos/language/scene_choice.h"

namespace carom::demos {

/// What all scenes of a gallery share.
struct GalleryShape {
  std::filesystem::path folder;
  int width = 480;
  int height = 270;
  double fps = 15.0;  ///< Of the moving pictures.
  std::string gl = "auto";
};

/// A file of the gallery, relative to its folder.
struct GalleryFile {
  std::string name;
  std::uint64_t hash = 0;
  std::int64_t bytes = 0;
};

struct GalleryEntry {
  std::string name;
  std::string identity;  ///< Of all that its files follow from.
  std::string group;
  std::string description;
  std::string look_for;
  std::string command;  ///< That renders it.
  int bodies = 0;       ///< That move.
  double duration_s = 0.0;
  int width = 0;  ///< Of the moving picture.
  int height = 0;
  std::vector<GalleryFile> files;  ///< Its page, moving picture and still.

  Json json() const;
};
/// Throws InputError for what `json` did not write.
GalleryEntry galleryEntry(const Json& json);

/// Where a scene's files are, relative to the gallery's folder.
std::string galleryPage(const std::string& scene);
std::string galleryPicture(const std::string& scene);
std::string galleryStill(const std::string& scene);

/// Scene, program, and the shape of the pictures.
std::string galleryIdentity(const Scene& scene, const GalleryShape& shape);

/// Whether all files of the entry are there and as they were written.
bool isWhole(const GalleryEntry& entry, const std::filesystem::path& folder);

/// Removes those of its files that are as they were written.
void removeFiles(const GalleryEntry& entry, const std::filesystem::path& folder);

}  // namespace carom::demos
