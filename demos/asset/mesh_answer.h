#pragma once
// The meshes that the process that reads a file has, and what it answers: bytes. A letter, then an error's
// text, or the number of a system's refusal, or the number of parts and of each its five lists and its
// picture's number, the pictures, and the notes; a list begins with the number of its bytes. Tested in
// tests/demos/asset/mesh_answer_test.cpp.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "demos/asset/mesh_import.h"

namespace carom::demos {

inline constexpr std::size_t kMostMeshParts = 1024;

/// A mesh as it is read, placed in the file's frame.
struct ReadPart {
  using Place = std::array<double, 3>;
  using Point = std::array<float, 3>;
  using Corners = std::array<std::uint32_t, 3>;

  std::vector<Place> vertices;
  std::vector<Point> normals, colors, uv;  ///< Of the last the third number is 0.
  std::vector<Corners> triangles;
  std::int32_t picture = -1;
};

/// The part with those of its vertices that are named, in that order; what is alike in place, normal, colour
/// and place on the picture is one vertex. All that triangles name must be named.
ReadPart joinedPart(const ReadPart& part, const std::vector<unsigned>& named);

/// All that is read of a file.
struct ReadMeshes {
  std::vector<ReadPart> parts;
  std::vector<SurfacePicture> pictures;
  std::vector<std::string> notes;
};

std::vector<std::uint8_t> answerBytes(const ReadMeshes& read);
std::vector<std::uint8_t> errorBytes(const std::string& text);
std::vector<std::uint8_t> refusalBytes(const std::error_code& code);

/// Throws InputError with the error's text, or where it is no answer; std::system_error for a refusal.
ImportedMesh meshOfAnswer(std::span<const std::uint8_t> answer, const std::filesystem::path& path);

}  // namespace carom::demos
