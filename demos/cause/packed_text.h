#pragma once
// A text packed into a small file: as the pixels of a grey PNG image, for the renderer's PNG reader and
// writer are this program's one door to deflate, with its limits and its fuzzing. Tested in
// tests/demos/cause/packed_text_test.cpp.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace carom::demos {

/// The same bytes for the same text. `text` has at most renderer::kMaxPngPixels bytes.
std::vector<std::uint8_t> packedText(const std::string& text);

/// Throws InputError naming the file when it is no packed text.
std::string unpackedText(const std::filesystem::path& path);

}  // namespace carom::demos
