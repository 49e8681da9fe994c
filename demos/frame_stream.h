#pragma once
// Frames one after another without files: `render -o - --stream FORMAT`. A stream of png is the files' bytes
// in a row. Tested in tests/demos/frame_stream_test.cpp.

#include <cstdint>
#include <string>
#include <vector>

#include "demos/frame_writer.h"

namespace carom::demos {

enum class StreamFormat { kPpm, kPng, kRgb24 };
/// Throws UsageError.
StreamFormat streamFormat(const std::string& name);

/// The bytes of one frame.
std::vector<std::uint8_t> streamedFrame(StreamFormat format, const FrameToWrite& frame);

}  // namespace carom::demos
