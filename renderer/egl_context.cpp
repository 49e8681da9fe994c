// The context that EGL makes without a surface (EGL_MESA_platform_surfaceless): for Mesa from 25.1 on, which
// has no OSMesa. libEGL is opened when it is asked for, so that the program starts without it. Tested in
// tests/renderer/offscreen_context_test.cpp.
#include "renderer/offscreen_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <utility>

namespace carom::renderer {
namespace {

// Name without "egl", and the type of its pointer.
#define CAROM_EGL_FUNCTIONS(X)                        \
  X(GetProcAddress, PFNEGLGETPROCADDRESSPROC)         \
  X(GetPlatformDisplay, PFNEGLGETPLATFORMDISPLAYPROC) \
  X(Initialize, PFNEGLINITIALIZEPROC)                 \
  X(BindAPI, PFNEGLBINDAPIPROC)                       \
  X(ChooseConfig, PFNEGLCHOOSECONFIGPROC)             \
  X(CreateContext, PFNEGLCREATECONTEXTPROC)           \
  X(DestroyContext, PFNEGLDESTROYCONTEXTPROC)         \
  X(GetCurrentContext, PFNEGLGETCURRENTCONTEXTPROC)   \
  X(MakeCurrent, PFNEGLMAKECURRENTPROC)

struct EglFunctions {
#define CAROM_EGL_MEMBER(name, type) type name = nullptr;
  CAROM_EGL_FUNCTIONS(CAROM_EGL_MEMBER)
#undef CAROM_EGL_MEMBER
};

// The library stays open: Mesa's threads and exit handlers live in it.
EglFunctions loadEgl() {
  void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw NoRenderer("there is no libEGL.so.1 here");
  EglFunctions egl;
#define CAROM_EGL_LOAD(name, type)                                \
  egl.name = reinterpret_cast<type>(dlsym(library, "egl" #name)); \
  if (egl.name == nullptr) throw NoRenderer("libEGL lacks egl" #name " (EGL 1.5 is needed)");
  CAROM_EGL_FUNCTIONS(CAROM_EGL_LOAD)
#undef CAROM_EGL_LOAD
  return egl;
}

class EglContext final : public OffscreenContext {
 public:
  EglContext() : egl_(loadEgl()), display_(openDisplay()), context_(create()) {
    try {
      makeCurrent();
      examine("EGL", egl_.GetProcAddress);
    } catch (...) {
      destroy();
      throw;
    }
  }
  ~EglContext() override { destroy(); }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void makeCurrent() override {
    if (egl_.GetCurrentContext() == context_) return;
    if (egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
      throw NoRenderer("EGL refuses to make its context current");
  }

 private:
  // All contexts of a process share the display, so that none of them terminates it.
  EGLDisplay openDisplay() const {
    const EGLDisplay display =
        egl_.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || egl_.Initialize(display, nullptr, nullptr) != EGL_TRUE)
      throw NoRenderer(
          "EGL has no surfaceless display here (Mesa's libegl-mesa0 and libgl1-mesa-dri are needed)");
    return display;
  }

  EGLContext create() const {
    EGLConfig config = nullptr;
    EGLint count = 0;
    const EGLint any_surface[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    if (egl_.BindAPI(EGL_OPENGL_API) != EGL_TRUE ||
        egl_.ChooseConfig(display_, any_surface, &config, 1, &count) != EGL_TRUE || count < 1)
      throw NoRenderer("EGL offers no OpenGL here (Mesa's libgl1-mesa-dri is needed)");
    for (const auto& [major, minor] : {std::pair{kGlMajor, kGlMinor}, {3, 2}}) {
      const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                               major,
                               EGL_CONTEXT_MINOR_VERSION,
                               minor,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
      const EGLContext context = egl_.CreateContext(display_, config, EGL_NO_CONTEXT, wanted);
      if (context != EGL_NO_CONTEXT) return context;
    }
    throw NoRenderer("EGL offers no OpenGL core context here");
  }

  void destroy() const {
    if (egl_.GetCurrentContext() == context_)
      egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl_.DestroyContext(display_, context_);
  }

  EglFunctions egl_;
  EGLDisplay display_;
  EGLContext context_;
};

}  // namespace

std::unique_ptr<OffscreenContext> createEglContext() {
  return std::make_unique<EglContext>();
}

}  // namespace carom::renderer
