#pragma once
// The index page of a gallery: its scenes by group, each with its moving picture, what it shows, what to look
// for, the command that makes it, and its page. Opens from disk and needs nothing else but the gallery's own
// pictures. Tested in tests/demos/gallery/gallery_index_test.cpp and, in a browser,
// tests/demos/gallery/gallery_program_test.cpp.

#include <span>
#include <string>
#include <vector>

#include "demos/gallery/gallery_entry.h"

namespace carom::demos {

/// The groups in the order in which they are shown: those of Carom's own scenes, then others by name, and
/// last "more".
std::vector<std::string> galleryGroups(std::span<const GalleryEntry> entries);

std::string galleryIndex(std::span<const GalleryEntry> entries);

}  // namespace carom::demos
