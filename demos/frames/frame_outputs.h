#pragma once
// What `render --aov` writes beside each frame: depth, world normals and body ids as PNG files that lie pixel
// on pixel with it. The number in a pixel is that of the surface that the ray through the pixel's middle
// meets first, on the engine's own solids; the smoothing of the frame's edges moves none, and water is
// see-through.
//   depth   16-bit grey: depth along the view axis in units of `metresPerUnit`, rounded; 65534 for that and
//           beyond, 65535 for the sky. The unit is the same for all frames of a run.
//   normal  16-bit RGB: 32768 + 32767 * (x, y, z) of the unit normal, world frame, rounded; 0 for the sky
//   id      16-bit grey: 1 + the body's place in the scene, 0 for the sky
// Tested in tests/demos/frames/frame_outputs_test.cpp and, on all shipped scenes,
// tests/demos/program/scene_outputs_test.cpp.

#include <string>
#include <vector>

#include "demos/format/json.h"
#include "renderer/frame/frame_renderer.h"
#include "renderer/image/png.h"
#include "renderer/image/raster.h"

namespace carom::demos {

enum class FrameOutput { kDepth, kNormal, kId };
const std::string& nameOf(FrameOutput output);

inline constexpr int kSkyDepth = 65535;
inline constexpr int kMostDepth = 65534;

/// The outputs of a list such as "depth,id", in the order of the enumeration, each once; none for an empty
/// text. Throws UsageError with the nearest name.
std::vector<FrameOutput> readOutputs(const std::string& text);

/// What a run's outputs share.
struct OutputScale {
  double depth_range_m = 0.0;  ///< That of the value 65534.
  double metresPerUnit() const { return depth_range_m / kMostDepth; }
};
/// Twice the depth of whatever body but the ground reaches farthest at the start, rounded up to 1, 2 or 5
/// times a power of ten.
OutputScale outputScale(std::span<const renderer::Instance> start, std::span<const Solid> solids,
                        const renderer::Camera& camera);

renderer::Raster outputRaster(FrameOutput output, const renderer::SurfaceImage& surfaces,
                              const OutputScale& scale);

/// The text of a frame, and what its output's numbers mean.
renderer::PngText outputText(FrameOutput output, const renderer::PngText& frame_text,
                             const OutputScale& scale);

/// For the manifest: what the numbers of each output mean, with the bodies' names where there are ids.
Json outputsJson(const std::vector<FrameOutput>& outputs, const OutputScale& scale,
                 const std::vector<std::string>& bodies);

}  // namespace carom::demos
