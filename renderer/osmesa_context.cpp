// The context that OSMesa makes: Mesa 17 to 25.0, linked. Tested in
// tests/renderer/offscreen_context_test.cpp.
#include "renderer/offscreen_context.h"

#include <GL/osmesa.h>

#include <array>
#include <cstdint>
#include <utility>

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

class OsmesaContext final : public OffscreenContext {
 public:
  OsmesaContext() : context_(create()) {
    try {
      makeCurrent();
      examine("OSMesa", OSMesaGetProcAddress);
    } catch (...) {
      OSMesaDestroyContext(context_);
      throw;
    }
  }
  ~OsmesaContext() override { OSMesaDestroyContext(context_); }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  void makeCurrent() override {
    if (OSMesaGetCurrentContext() == context_) return;
    if (OSMesaMakeCurrent(context_, unused_.data(), GL_UNSIGNED_BYTE, kUnusedSide, kUnusedSide) != GL_TRUE)
      throw NoRenderer("OSMesa refuses to make its context current");
  }

 private:
  // An older context than needed is taken as well: it can say which renderer it is, for the refusal in
  // examine().
  static OSMesaContext create() {
    for (const auto& [major, minor] : {std::pair{kGlMajor, kGlMinor}, {3, 2}}) {
      const int wanted[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            major,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            minor,
                            0};
      OSMesaContext context = OSMesaCreateContextAttribs(wanted, nullptr);
      if (context != nullptr) return context;
    }
    throw NoRenderer(
        "OSMesa offers no OpenGL core context here (needs libosmesa6 of Mesa 17 to 25.0, with llvmpipe)");
  }

  // OSMesa wants a buffer to be current; everything is drawn into framebuffer objects instead.
  static constexpr int kUnusedSide = 4;
  std::array<std::uint8_t, 4 * kUnusedSide * kUnusedSide> unused_{};
  OSMesaContext context_;
};

}  // namespace

std::unique_ptr<OffscreenContext> createOsmesaContext() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace carom::renderer
