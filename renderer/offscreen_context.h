#pragma once
// A GL context that needs no display: OSMesa's, or EGL's without a surface; both are Mesa's llvmpipe and draw
// the same pixels. Each is known to one file alone (osmesa_context.cpp, egl_context.cpp). The context owns
// every GL object made in it: they are freed with it. Tested in tests/renderer/offscreen_context_test.cpp.

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

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

/// The environment names a driver that cannot serve; the message says what to do, and no package helps.
class WrongDriver : public NoRenderer {
 public:
  using NoRenderer::NoRenderer;
};

/// How Mesa generates its code. It reads this once a process, so the first context of a process decides.
enum class PixelPolicy {
  kFast,      ///< The widest vectors that work here. Other CPUs may differ by 1/255, by more at edges.
  kPortable,  ///< The same pixels on every x86-64 CPU with SSE4.1, about a third slower: golden frames.
};

/// Who makes the context. EGL is looked for when it is asked for; the program does not link it.
enum class GlBackend { kOsmesa, kEgl };
/// "osmesa", "egl".
const std::vector<std::string>& backendNames();
/// The one of that name, which must be one of them.
GlBackend backendOf(const std::string& name);

class OffscreenContext {
 public:
  virtual ~OffscreenContext() = default;
  /// Binds the context to the calling thread. Cheap when it is bound already. An EGL context stays with the
  /// first thread that binds it: NoRenderer on another.
  virtual void makeCurrent() = 0;

  const GlFunctions& gl() const { return gl_; }
  const ContextInfo& info() const { return info_; }

 protected:
  using FindFunction = void (*(*)(const char* name))();
  /// Loads GL's functions and asks the context, which is current, what it is; `maker` is its name in
  /// messages. Throws NoRenderer when it is not what frames need.
  void examine(const std::string& maker, FindFunction find);

  GlFunctions gl_;
  ContextInfo info_;
};

/// The least OpenGL: instances with a base need 4.2, textureGather with comparison 4.0.
inline constexpr int kGlMajor = 4, kGlMinor = 2;

/// A context of OpenGL 4.2 core or later, current on the calling thread. `threads` fill its pixels (0: as
/// many as Mesa likes); as the policy, that is settled by a process's first context. Throws NoRenderer.
std::unique_ptr<OffscreenContext> createOffscreenContext(PixelPolicy policy,
                                                         GlBackend backend = GlBackend::kOsmesa,
                                                         int threads = 0);

/// The two makers, for createOffscreenContext.
std::unique_ptr<OffscreenContext> createOsmesaContext();
std::unique_ptr<OffscreenContext> createEglContext();

}  // namespace carom::renderer
