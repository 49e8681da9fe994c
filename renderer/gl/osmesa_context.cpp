// The context that OSMesa makes: Mesa 17 to 25.0. The library is opened when it is asked for, so that the
// program starts without it; its few names are written out here (Mesa's GL/osmesa.h, version 11.2), so that
// the build needs nothing of it either. Tested in tests/renderer/gl/offscreen_context_test.cpp.
#include "renderer/gl/offscreen_context.h"

#include <array>
#include <cstdint>
#include <utility>

#include <dlfcn.h>

#include "renderer/gl/gl_library.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CAROM_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define CAROM_ADDRESS_SANITIZER
#endif
#ifdef CAROM_ADDRESS_SANITIZER
// OSMesa 22.3 keeps some 150 bytes of every destroyed context, EGL its display; they are not ours to free.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa\nleak:libEGL\nleak:_dri.so";
}
#endif

namespace carom::renderer {
namespace {

enum OsmesaName : int {
  kFormat = 0x22,
  kDepthBits = 0x30,
  kProfile = 0x33,
  kCoreProfile = 0x34,
  kContextMajorVersion = 0x36,
  kContextMinorVersion = 0x37
};
using OsmesaHandle = struct osmesa_context*;
using OsmesaProc = void (*)();

struct OsmesaFunctions {
  OsmesaHandle (*CreateContextAttribs)(const int* names_and_values, OsmesaHandle shared) = nullptr;
  void (*DestroyContext)(OsmesaHandle) = nullptr;
  GLboolean (*MakeCurrent)(OsmesaHandle, void* buffer, GLenum type, GLsizei width, GLsizei height) = nullptr;
  OsmesaHandle (*GetCurrentContext)() = nullptr;
  OsmesaProc (*GetProcAddress)(const char* name) = nullptr;
};

template <typename Function>
void load(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr)
    throw NoRenderer(std::string("libOSMesa lacks ") + name + " (Mesa 17 to 25.0 has it)");
}

OsmesaFunctions loadOsmesa() {
  void* library = openLibrary("libOSMesa.so.8");
  OsmesaFunctions osmesa;
  load(library, "OSMesaCreateContextAttribs", osmesa.CreateContextAttribs);
  load(library, "OSMesaDestroyContext", osmesa.DestroyContext);
  load(library, "OSMesaMakeCurrent", osmesa.MakeCurrent);
  load(library, "OSMesaGetCurrentContext", osmesa.GetCurrentContext);
  load(library, "OSMesaGetProcAddress", osmesa.GetProcAddress);
  return osmesa;
}

class OsmesaContext final : public OffscreenContext {
 public:
  OsmesaContext() : osmesa_(loadOsmesa()), context_(create()) {
    try {
      makeCurrent();
      examine(GlBackend::kOsmesa, "OSMesa", osmesa_.GetProcAddress);
    } catch (...) {
      osmesa_.DestroyContext(context_);
      throw;
    }
  }
  ~OsmesaContext() override { osmesa_.DestroyContext(context_); }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  void makeCurrent() override {
    if (osmesa_.GetCurrentContext() == context_) return;
    if (osmesa_.MakeCurrent(context_, unused_.data(), GL_UNSIGNED_BYTE, kUnusedSide, kUnusedSide) != GL_TRUE)
      throw NoRenderer("OSMesa refuses to make its context current");
  }

 private:
  // An older context than needed is taken as well: it can say which renderer it is, for the refusal in
  // examine().
  OsmesaHandle create() const {
    for (const auto& [major, minor] : {std::pair{kGlMajor, kGlMinor}, {3, 2}}) {
      const int wanted[] = {kFormat,
                            GL_RGBA,
                            kDepthBits,
                            0,
                            kProfile,
                            kCoreProfile,
                            kContextMajorVersion,
                            major,
                            kContextMinorVersion,
                            minor,
                            0};
      const OsmesaHandle context = osmesa_.CreateContextAttribs(wanted, nullptr);
      if (context != nullptr) return context;
    }
    throw NoRenderer(
        "OSMesa offers no OpenGL core context here (needs libosmesa6 of Mesa 17 to 25.0, with llvmpipe)");
  }

  // OSMesa wants a buffer to be current; everything is drawn into framebuffer objects instead.
  static constexpr int kUnusedSide = 4;
  std::array<std::uint8_t, 4 * kUnusedSide * kUnusedSide> unused_{};
  OsmesaFunctions osmesa_;
  OsmesaHandle context_;
};

}  // namespace

std::unique_ptr<OffscreenContext> createOsmesaContext() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace carom::renderer
