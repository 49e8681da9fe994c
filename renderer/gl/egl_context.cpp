// The context that EGL makes without a surface, for Mesa from 25.1 on, which has no OSMesa: on the display
// that is no display (EGL_MESA_platform_surfaceless), else on the software device (EGL_EXT_platform_device).
// libEGL is opened when it is asked for, so that the program starts without it. Tested in
// tests/renderer/gl/offscreen_context_test.cpp.
#include "renderer/gl/offscreen_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <string_view>
#include <utility>

#include "renderer/gl/gl_library.h"

namespace carom::renderer {
namespace {

// Name without "egl", and the type of its pointer.
#define CAROM_EGL_FUNCTIONS(X)                        \
  X(GetProcAddress, PFNEGLGETPROCADDRESSPROC)         \
  X(GetPlatformDisplay, PFNEGLGETPLATFORMDISPLAYPROC) \
  X(Initialize, PFNEGLINITIALIZEPROC)                 \
  X(QueryString, PFNEGLQUERYSTRINGPROC)               \
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

EglFunctions loadEgl() {
  void* library = openLibrary("libEGL.so.1");
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
      examine(GlBackend::kEgl, "EGL", egl_.GetProcAddress);
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
    const EGLDisplay surfaceless =
        egl_.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (isMesas(surfaceless)) return surfaceless;
    const EGLDisplay device = egl_.GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, softwareDevice(), nullptr);
    if (isMesas(device)) return device;
    throw NoRenderer(
        "EGL has no surfaceless display here (Mesa's libegl-mesa0 and libgl1-mesa-dri are needed)");
  }

  // A graphics card's own EGL may answer first, and draws other pixels.
  bool isMesas(EGLDisplay display) const {
    if (display == EGL_NO_DISPLAY || egl_.Initialize(display, nullptr, nullptr) != EGL_TRUE) return false;
    const char* vendor = egl_.QueryString(display, EGL_VENDOR);
    return vendor != nullptr && std::string_view(vendor).find("Mesa") != std::string_view::npos;
  }

  EGLDeviceEXT softwareDevice() const {
    const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl_.GetProcAddress("eglQueryDevicesEXT"));
    const auto tell =
        reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl_.GetProcAddress("eglQueryDeviceStringEXT"));
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (query == nullptr || tell == nullptr ||
        query(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE)
      return EGL_NO_DEVICE_EXT;
    for (EGLint i = 0; i < count; ++i) {
      const char* extensions = tell(devices[static_cast<std::size_t>(i)], EGL_EXTENSIONS);
      if (extensions != nullptr &&
          std::string_view(extensions).find("EGL_MESA_device_software") != std::string_view::npos)
        return devices[static_cast<std::size_t>(i)];
    }
    return EGL_NO_DEVICE_EXT;
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
