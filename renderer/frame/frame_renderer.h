#pragma once
// Draws frames off screen from plain values. The public face of the renderer: it knows shapes, poses, colours
// and a camera, nothing of physics. One sun with soft shadows, light from sky and ground, contact shadows,
// air between here and the horizon. Frames depend on the arguments of `draw` alone, not on earlier frames:
// what of a frame is as in the one before is not drawn again, and would come out the same. Tested in
// tests/renderer/frame/frame_renderer_test.cpp and partial_drawing_test.cpp.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/foundation/frames.h"
#include "engine/solid/solid.h"
#include "renderer/image/image.h"
#include "renderer/image/surface_image.h"
#include "renderer/view/projection.h"
#include "renderer/view/view.h"
#include "renderer/view/water_volume.h"

namespace carom::renderer {

/// What the last `draw` had to do: the same on every machine and either back end.
struct DrawWork {
  std::int64_t triangles = 0;      ///< Of bodies, in the picture, the shadow map and the mirror.
  std::int64_t pixels = 0;         ///< Of the blocks drawn anew, over all exposures.
  std::int64_t shadow_texels = 0;  ///< Of the shadow map's blocks drawn anew.
  std::int64_t mirror_texels = 0;  ///< Of the blocks drawn anew of what the ground mirrors.
};

class FrameRenderer {
 public:
  /// Creates the context and uploads the solids' geometry (kept by value; the span need not outlive the
  /// call). Throws InputError for a size outside [1, kMaxImageSide] or no light direction, NoRenderer without
  /// a GL context, NoImageMemory without memory for the images.
  FrameRenderer(const Settings& settings, std::span<const Solid> solids);
  ~FrameRenderer();
  FrameRenderer(const FrameRenderer&) = delete;
  FrameRenderer& operator=(const FrameRenderer&) = delete;

  /// Draws one frame, or what of it differs from the last; the image is valid until the next call. From any
  /// thread, one at a time. Throws InputError when the camera is impossible (see `cameraAxes`). `drawn` is
  /// called when GL has finished and the image is about to be read back, to tell the two apart; waiting for
  /// GL there changes no pixel. `water` is drawn over all of it; it is not in `surfaces()`.
  /// `moments` are the instances at times spread over those at which the shutter is open; the exposures of a
  /// preset that has several show them in turn, and `instances` is what `surfaces()` tells of.
  const Image& draw(std::span<const Instance> instances, const Camera& camera,
                    const std::function<void()>& drawn = {}, std::span<const WaterVolume> water = {},
                    std::span<const std::vector<Instance>> moments = {});

  /// The next `draw` draws all of its frame, as if it were the first.
  void drawAnew();

  /// How many exposures a frame has.
  int exposures() const;

  /// What the middle of each pixel of the last `draw` shows: the engine's own solids, with sharp edges and
  /// exact rounds, and the endless ground. Computed at the first call after a `draw`, in 5 to 20 ms at 720p;
  /// valid until the next `draw`. Before any `draw` the images are empty.
  const SurfaceImage& surfaces();
  /// Its depth alone.
  const DepthImage& depth() { return surfaces().depth; }
  ContextInfo info() const;
  const DrawWork& work() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom::renderer
