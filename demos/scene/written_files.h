#pragma once
// The files that a command writes: none of them is one that it reads, and no two are the same, by whatever
// paths and links they are named. Tested in tests/demos/scene/written_files_test.cpp.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "demos/scene/scene.h"

namespace carom::demos {

/// A file or folder with what names it: an option, an argument, or "the scene".
struct NamedFile {
  std::string name;
  std::filesystem::path file;
};

/// Standard output in the place of a file.
inline constexpr const char* kStandardOutput = "-";

/// Throws UsageError where two of them are the same. Devices and pipes take from anybody.
void requireDistinct(std::span<const NamedFile> written);

/// Throws UsageError where one of `written` is one of `read`.
void requireNotRead(std::span<const NamedFile> written, std::span<const NamedFile> read);

/// What a scene is made of: its files, its meshes', and what those name. Throws InputError.
std::vector<NamedFile> filesOf(const Scene& scene, const std::optional<std::filesystem::path>& mesh);

}  // namespace carom::demos
