#include "demos/frames/frame_stream.h"

#include "demos/frames/frame_identity.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"

namespace carom::demos {

StreamFormat streamFormat(const std::string& name) {
  if (name == "ppm") return StreamFormat::kPpm;
  if (name == "png") return StreamFormat::kPng;
  if (name == "rgb24") return StreamFormat::kRgb24;
  throw UsageError("--stream " + name + ": accepted: ppm, png or rgb24");
}

std::vector<std::uint8_t> streamedFrame(StreamFormat format, const FrameToWrite& frame) {
  if (format == StreamFormat::kPng) return encodedFrame(frame.image, frame.text).bytes;
  if (format == StreamFormat::kRgb24) return frame.image.rgb;
  const std::string head =
      "P6\n" + std::to_string(frame.image.width) + " " + std::to_string(frame.image.height) + "\n255\n";
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  bytes.insert(bytes.end(), frame.image.rgb.begin(), frame.image.rgb.end());
  return bytes;
}

std::vector<std::uint8_t> streamedOutput(StreamFormat format, const OutputToWrite& output) {
  REQUIRE(format != StreamFormat::kRgb24, output.raster.bits);
  const renderer::Raster& raster = output.raster;
  if (format == StreamFormat::kPng) return encodedOutput(raster, output.text).bytes;
  const std::string head = std::string(raster.channels == 1 ? "P5" : "P6") + "\n" +
                           std::to_string(raster.width) + " " + std::to_string(raster.height) + "\n" +
                           std::to_string(raster.fullScale()) + "\n";
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  for (const std::uint16_t sample : raster.samples) {
    bytes.push_back(static_cast<std::uint8_t>(sample >> 8));
    bytes.push_back(static_cast<std::uint8_t>(sample & 0xff));
  }
  return bytes;
}

}  // namespace carom::demos
