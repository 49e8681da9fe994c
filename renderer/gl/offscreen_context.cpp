#include "renderer/gl/offscreen_context.h"

#include <atomic>
#include <cstdlib>
#include <thread>
#include <utility>
#include <vector>

#include "engine/foundation/contract.h"
#include "renderer/gl/shader_cache.h"

namespace carom::renderer {
namespace {

void setUnlessSet(const char* name, const char* value) {
  setenv(name, value, 0);
}

// Mesa takes the driver's name on trust and crashes when it knows none of that name. Softpipe is let through,
// to be refused for what it is.
void checkDriver() {
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (driver == nullptr) return;
  const std::string name = driver;
  if (name.empty())
    unsetenv("GALLIUM_DRIVER");
  else if (name != "llvmpipe" && name != "softpipe")
    throw WrongDriver("GALLIUM_DRIVER=" + name +
                      " is no driver that draws here; accepted: llvmpipe, or unset it");
}

// Golden frames shall depend on nothing that an earlier run has left, so portable pixels use no cache.
void placeShaderCache(PixelPolicy policy) {
  if (policy == PixelPolicy::kPortable) {
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    return;
  }
  if (std::getenv("MESA_SHADER_CACHE_DIR") != nullptr) return;
  if (const std::optional<std::filesystem::path> folder = shaderCacheFolder())
    setenv("MESA_SHADER_CACHE_DIR", folder->c_str(), 1);
  else
    setUnlessSet("MESA_SHADER_CACHE_DISABLE", "true");
}

// llvmpipe and Mesa's queues start threads and do not look whether they got them: without, they wait for
// ever. So as many are started first; where the system refuses one, its std::system_error says so.
void requireThreads(int threads) {
  constexpr unsigned kQueues = 4;  // the shader cache has the most
  const unsigned draw = threads > 0 ? static_cast<unsigned>(threads) : std::thread::hardware_concurrency();
  std::atomic<bool> all_started = false;
  std::vector<std::jthread> started;
  try {
    for (unsigned i = 0; i < draw + kQueues; ++i)
      started.emplace_back([&all_started] { all_started.wait(false); });
  } catch (...) {
    all_started = true;
    all_started.notify_all();
    throw;
  }
  all_started = true;
  all_started.notify_all();
}

// A GPU draws other pixels, so EGL is told not to look for one.
void setMesaEnvironment(PixelPolicy policy, int threads) {
  checkDriver();
  if (policy == PixelPolicy::kPortable) {
    // Of eight floats without AVX llvmpipe takes the root and divides, where it encodes sRGB. Of four it asks
    // the processor for an approximate reciprocal root, which Intel's and AMD's answer differently.
    setenv("GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1", 1);
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  }
  placeShaderCache(policy);
  if (threads > 0) setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
}

std::unique_ptr<OffscreenContext> createAsked(GlBackend backend) {
  std::unique_ptr<OffscreenContext> context =
      backend == GlBackend::kEgl ? createEglContext() : createOsmesaContext();
  context->giveReason("asked for");
  return context;
}

/// OSMesa where it serves, for it starts sooner (no display to open); else EGL. A wrong driver is wrong for
/// both.
std::unique_ptr<OffscreenContext> firstThatServes() {
  std::string no_osmesa;
  try {
    std::unique_ptr<OffscreenContext> context = createOsmesaContext();
    context->giveReason("the first choice, and it is here");
    return context;
  } catch (const WrongDriver&) {
    throw;
  } catch (const NoRenderer& error) {
    no_osmesa = error.what();
  }
  try {
    std::unique_ptr<OffscreenContext> context = createEglContext();
    context->giveReason(no_osmesa);
    return context;
  } catch (const WrongDriver&) {
    throw;
  } catch (const NoRenderer& error) {
    throw NoRenderer(no_osmesa + "; " + error.what());
  }
}

}  // namespace

void OffscreenContext::examine(GlBackend backend, const std::string& maker, FindFunction find) {
  info_.backend = backend;
#define CAROM_GL_LOAD(name, type)                      \
  gl_.name = reinterpret_cast<type>(find("gl" #name)); \
  if (gl_.name == nullptr) throw NoRenderer(maker + " lacks gl" #name);
  CAROM_GL_FUNCTIONS(CAROM_GL_LOAD)
#undef CAROM_GL_LOAD
  const auto text = [this](GLenum name) -> std::string {
    const GLubyte* answer = gl_.GetString(name);
    return answer == nullptr ? "" : reinterpret_cast<const char*>(answer);
  };
  info_.renderer = text(GL_RENDERER);
  info_.version = text(GL_VERSION);
  gl_.GetIntegerv(GL_MAX_SAMPLES, &info_.max_samples);
  if (info_.renderer.empty())
    throw NoRenderer(maker + "'s context does not answer (another GL library in its place?)");
  if (info_.renderer.find("softpipe") != std::string::npos)
    throw WrongDriver(
        maker + " draws with softpipe, which is far too slow; llvmpipe is needed (unset GALLIUM_DRIVER)");
  GLint major = 0, minor = 0;
  gl_.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl_.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (std::pair(major, minor) < std::pair(kGlMajor, kGlMinor))
    throw NoRenderer("OpenGL 4.2 is needed, but " + maker + " offers " + info_.version + " with " +
                     info_.renderer);
}

std::unique_ptr<OffscreenContext> createOffscreenContext(PixelPolicy policy, GlBackend backend, int threads) {
  setMesaEnvironment(policy, threads);
  requireThreads(threads);
  return backend == GlBackend::kAuto ? firstThatServes() : createAsked(backend);
}

}  // namespace carom::renderer
