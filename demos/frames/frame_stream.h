#pragma once
// Frames one after another without files: `render -o - --stream FORMAT`. A stream of png is the files' bytes
// in a row. Tested in tests/demos/frames/frame_stream_test.cpp.

#include <cstdint>
#include <string>
#include <vector>

#include "demos/frames/frame_writer.h"

namespace carom::demos {

enum class StreamFormat { kPpm, kPng, kRgb24 };
/// Throws UsageError.
StreamFormat streamFormat(const std::string& name);

/// The bytes of one frame.
std::vector<std::uint8_t> streamedFrame(StreamFormat format, const FrameToWrite& frame);

/// The bytes of another output in the place of its frame, 16 bits a sample: the bytes of its file, or for ppm
/// a PGM of what is grey and a PPM of what is not, high bytes first. Not for rgb24.
std::vector<std::uint8_t> streamedOutput(StreamFormat format, const OutputToWrite& output);

}  // namespace carom::demos
