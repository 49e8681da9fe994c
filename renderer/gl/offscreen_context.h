#pragma once
// A GL context that needs no display: OSMesa's, or EGL's without a surface. Each is known to one file alone
// (osmesa_context.cpp, egl_context.cpp). The context owns every GL object made in it: they are freed with it.
// Tested in tests/renderer/gl/offscreen_context_test.cpp.

#include <memory>
#include <string>

#include "renderer/gl/gl_functions.h"
#include "renderer/view/gl_backend.h"

namespace carom::renderer {

class OffscreenContext {
 public:
  virtual ~OffscreenContext() = default;
  /// Binds the context to the calling thread. Cheap when it is bound already. An EGL context stays with the
  /// first thread that binds it: NoRenderer on another.
  virtual void makeCurrent() = 0;

  const GlFunctions& gl() const { return gl_; }
  const ContextInfo& info() const { return info_; }
  void giveReason(const std::string& reason) { info_.reason = reason; }

 protected:
  using FindFunction = void (*(*)(const char* name))();
  /// Loads GL's functions and asks the context, which is current, what it is; `maker` is its name in
  /// messages. Throws NoRenderer when it is not what frames need.
  void examine(GlBackend backend, const std::string& maker, FindFunction find);

  GlFunctions gl_;
  ContextInfo info_;
};

/// The least OpenGL: instances with a base need 4.2, textureGather with comparison 4.0.
inline constexpr int kGlMajor = 4, kGlMinor = 2;

/// A context of OpenGL 4.2 core or later, current on the calling thread. `threads` fill its pixels (0: as
/// many as Mesa likes); as the policy, that is settled by a process's first context. Throws NoRenderer; with
/// kAuto, that says why neither serves.
std::unique_ptr<OffscreenContext> createOffscreenContext(PixelPolicy policy,
                                                         GlBackend backend = GlBackend::kAuto,
                                                         int threads = 0);

/// The two makers, for createOffscreenContext.
std::unique_ptr<OffscreenContext> createOsmesaContext();
std::unique_ptr<OffscreenContext> createEglContext();

}  // namespace carom::renderer
