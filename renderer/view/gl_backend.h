#pragma once
// Who makes the GL context that frames are drawn with, and what it answers; plain values, without GL's own
// headers. A choice of `kAuto` takes OSMesa where it is and EGL without a surface where not: both are Mesa's
// llvmpipe and draw the same pixels. Tested in tests/renderer/gl/offscreen_context_test.cpp.

#include <stdexcept>
#include <string>
#include <vector>

namespace carom::renderer {

/// Both libraries are looked for when the first context is made; nothing links them.
enum class GlBackend { kAuto, kOsmesa, kEgl };
/// "auto", "osmesa", "egl".
const std::vector<std::string>& backendNames();
const std::string& nameOf(GlBackend backend);
/// The one of that name, which must be one of them.
GlBackend backendOf(const std::string& name);

/// How Mesa generates its code. It reads this once a process, so the first context of a process decides.
enum class PixelPolicy {
  kFast,      ///< The widest vectors that work here. Other CPUs may differ by 1/255, by more at edges.
  kPortable,  ///< The same pixels on every x86-64 CPU with SSE4.1, about a third slower: golden frames.
};

/// What GL answers, for `carom doctor` and manifests.
struct ContextInfo {
  std::string renderer;  ///< e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;   ///< e.g. "4.5 (Core Profile) Mesa 22.3.6"
  int max_samples = 0;
  GlBackend backend = GlBackend::kAuto;  ///< Who made the context: not kAuto.
  std::string reason = {};               ///< Why that one, e.g. "there is no libOSMesa.so.8 here".
};

/// Thrown when no usable GL context can be had; one line, says what is missing.
class NoRenderer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The environment names a driver that cannot serve; the message says what to do, and no package helps.
class WrongDriver : public NoRenderer {
 public:
  using NoRenderer::NoRenderer;
};

/// The driver has no memory for the images that a frame needs; one line, says which.
class NoImageMemory : public std::runtime_error {
 public:
  /// `images` in the plural, of `width` x `height` pixels.
  NoImageMemory(const std::string& images, int width, int height);
};

}  // namespace carom::renderer
