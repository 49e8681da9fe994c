#pragma once
// Makes one scene's part of a gallery: the page that plays it, a moving picture and a still. One run gives
// all three. Tested in tests/demos/gallery/gallery_program_test.cpp.

#include "demos/gallery/gallery_entry.h"

namespace carom::demos {

/// A moving picture has at most so many bytes, and shows at most so much of a run.
inline constexpr std::size_t kMostPictureBytes = 300 * 1024;
inline constexpr double kLongestPicture_s = 8.0;
/// Pages of scenes with more moving bodies have half the frames a second.
inline constexpr int kManyBodies = 120;

/// Writes the files. Throws what reading, simulating, drawing and writing the scene throw.
GalleryEntry makeGalleryScene(const SceneChoice& choice, const GalleryShape& shape);

}  // namespace carom::demos
