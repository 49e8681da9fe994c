#include "renderer/view/gl_backend.h"

#include <algorithm>

#include "engine/foundation/contract.h"

namespace carom::renderer {

const std::vector<std::string>& backendNames() {
  static const std::vector<std::string> names{"auto", "osmesa", "egl"};
  return names;
}

const std::string& nameOf(GlBackend backend) {
  return backendNames()[static_cast<std::size_t>(backend)];
}

GlBackend backendOf(const std::string& name) {
  const auto found = std::find(backendNames().begin(), backendNames().end(), name);
  REQUIRE(found != backendNames().end(), name);
  return static_cast<GlBackend>(found - backendNames().begin());
}

NoImageMemory::NoImageMemory(const std::string& images, int width, int height)
    : std::runtime_error("out of memory: the GL driver has no room for " + images + " of " +
                         std::to_string(width) + "x" + std::to_string(height)) {}

}  // namespace carom::renderer
