#pragma once
// Deflate for frames that are written once and often: ISA-L's level 1, a fifth of zlib's time for about as
// many bytes. quick_deflate.cpp is the only file that names ISA-L; a build without it says so and png.cpp
// takes zlib. Tested in tests/renderer/image/png_test.cpp.

#include <cstdint>
#include <span>
#include <vector>

namespace carom::renderer {

/// Whether this build has it.
bool hasQuickDeflate();

/// `bytes` as a zlib stream (RFC 1950). Only where there is a quick deflate.
std::vector<std::uint8_t> quickDeflate(std::span<const std::uint8_t> bytes);

/// A part of such a stream that refers to no other: a stream's two bytes of head, its parts, the last one
/// packed as such, and its checksum make it whole. Only where there is a quick deflate.
struct DeflatedPart {
  std::vector<std::uint8_t> packed;
  std::uint32_t adler = 1;  ///< Of what was packed.
};
DeflatedPart quickDeflatePart(std::span<const std::uint8_t> bytes, bool is_last);

}  // namespace carom::renderer
