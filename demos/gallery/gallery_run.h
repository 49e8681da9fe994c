#pragma once
// Makes a gallery: each scene by a process of this program, several at a time; those that are as they were
// are kept. What is finished is noted at once, so that a run that was interrupted goes on where it was.
// Tested in tests/demos/gallery/gallery_program_test.cpp.

#include <functional>
#include <string>
#include <vector>

#include "demos/gallery/gallery_entry.h"

namespace carom::demos {

struct GalleryPlan {
  std::vector<std::string> scenes;  ///< Names or files; of different names.
  GalleryShape shape;
  int jobs = 1;
};

/// A scene that could not be made.
struct GalleryFailure {
  std::string name;
  int code = 0;      ///< The exit code of its process.
  std::string line;  ///< What that said.
};

struct GalleryOutcome {
  std::vector<GalleryEntry> entries;  ///< In the plan's order.
  std::vector<GalleryFailure> failures;
  int kept = 0;
};

/// Removes what an earlier run wrote of scenes that are not in the gallery any more. `done` is told how many
/// scenes are finished. Throws UsageError for two scenes of one name, InputError for a scene that is not
/// there, CannotWrite where the folder has an index page of its own, Interrupted after ending what runs.
GalleryOutcome runGallery(const GalleryPlan& plan, const std::function<void(int)>& done);

/// The file in the gallery's folder that says what is in it.
inline constexpr const char* kGalleryFile = "gallery.json";
inline constexpr const char* kGalleryIndex = "index.html";

}  // namespace carom::demos
