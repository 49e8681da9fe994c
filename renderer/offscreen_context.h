#pragma once
// A GL context that needs no display. What creates it is known to offscreen_context.cpp alone (OSMesa today;
// a surfaceless EGL context fits behind the same interface). The context owns every GL object made in it:
// they are freed with it. Tested in tests/renderer/offscreen_context_test.cpp.

#include <memory>
#include <stdexcept>
#include <string>

#include "renderer/gl_functions.h"

namespace carom::renderer {

/// What GL answers, for `carom doctor` and manifests.
struct ContextInfo {
  std::string renderer;  ///< e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;   ///< e.g. "4.5 (Core Profile) Mesa 22.3.6"
  int max_samples = 0;
};

/// Thrown when no usable GL context can be had; one line, says what is missing.
class NoRenderer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How Mesa generates its code. It reads this once a process, so the first context of a process decides.
enum class PixelPolicy {
  kFast,      ///< The widest vectors that work here. Other CPUs may differ by 1/255 in a few pixels.
  kPortable,  ///< The same pixels on every x86-64 CPU with SSE4.1, about a third slower: golden frames.
};

class OffscreenContext {
 public:
  virtual ~OffscreenContext() = default;
  /// Binds the context to the calling thread. Cheap when it is bound already.
  virtual void makeCurrent() = 0;

  const GlFunctions& gl() const { return gl_; }
  const ContextInfo& info() const { return info_; }

 protected:
  GlFunctions gl_;
  ContextInfo info_;
};

/// A context of OpenGL 4.2 core or later, current on the calling thread. Throws NoRenderer.
std::unique_ptr<OffscreenContext> createOffscreenContext(PixelPolicy policy);

}  // namespace carom::renderer
