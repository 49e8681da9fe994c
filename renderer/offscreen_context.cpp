#include "renderer/offscreen_context.h"

#include <GL/osmesa.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <utility>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CAROM_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define CAROM_ADDRESS_SANITIZER
#endif
#ifdef CAROM_ADDRESS_SANITIZER
// OSMesa 22.3 keeps some 150 bytes of every destroyed context; they are not ours to free.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa";
}
#endif

namespace carom::renderer {
namespace {

constexpr int kMajor = 4, kMinor = 2;  // Instances with a base need 4.2; textureGather with comparison 4.0.

void setUnlessSet(const char* name, const char* value) {
  setenv(name, value, 0);
}

// Mesa keeps compiled shaders on disk keyed neither by CPU nor by vector width, so that a home shared between
// machines can serve code this CPU cannot run: the cache is off unless somebody asked for it. It would save
// 0.2 s a process.
void setMesaEnvironment(PixelPolicy policy) {
  if (policy == PixelPolicy::kPortable) {
    setenv("GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1", 1);
    setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  } else if (std::getenv("MESA_SHADER_CACHE_DIR") == nullptr) {
    setUnlessSet("MESA_SHADER_CACHE_DISABLE", "true");
  }
}

class OsmesaContext final : public OffscreenContext {
 public:
  OsmesaContext() : context_(create()) {
    try {
      makeCurrent();
      loadFunctions();
      describe();
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
  // describe().
  static OSMesaContext create() {
    for (const auto& [major, minor] : {std::pair{kMajor, kMinor}, {3, 2}}) {
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

  void loadFunctions() {
#define CAROM_GL_LOAD(name, type)                                      \
  gl_.name = reinterpret_cast<type>(OSMesaGetProcAddress("gl" #name)); \
  if (gl_.name == nullptr) throw NoRenderer("OSMesa lacks gl" #name);
    CAROM_GL_FUNCTIONS(CAROM_GL_LOAD)
#undef CAROM_GL_LOAD
  }

  void describe() {
    info_.renderer = text(GL_RENDERER);
    info_.version = text(GL_VERSION);
    gl_.GetIntegerv(GL_MAX_SAMPLES, &info_.max_samples);
    if (info_.renderer.empty())
      throw NoRenderer("OSMesa's context does not answer (another GL library in its place?)");
    if (info_.renderer.find("softpipe") != std::string::npos)
      throw NoRenderer(
          "OSMesa draws with softpipe, which is far too slow; llvmpipe is needed (unset GALLIUM_DRIVER)");
    GLint major = 0, minor = 0;
    gl_.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl_.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (std::pair(major, minor) < std::pair(kMajor, kMinor))
      throw NoRenderer("OpenGL 4.2 is needed, but OSMesa offers " + info_.version + " with " +
                       info_.renderer);
  }

  std::string text(GLenum name) const {
    const GLubyte* answer = gl_.GetString(name);
    return answer == nullptr ? "" : reinterpret_cast<const char*>(answer);
  }

  // OSMesa wants a buffer to be current; everything is drawn into framebuffer objects instead.
  static constexpr int kUnusedSide = 4;
  std::array<std::uint8_t, 4 * kUnusedSide * kUnusedSide> unused_{};
  OSMesaContext context_;
};

}  // namespace

std::unique_ptr<OffscreenContext> createOffscreenContext(PixelPolicy policy) {
  setMesaEnvironment(policy);
  return std::make_unique<OsmesaContext>();
}

}  // namespace carom::renderer
