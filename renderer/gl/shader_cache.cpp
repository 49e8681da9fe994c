#include "renderer/gl/shader_cache.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string_view>
#include <system_error>

namespace carom::renderer {
namespace {

// What Mesa's code depends on besides the processor.
constexpr std::array<const char*, 2> kMesaVariables{"GALLIUM_OVERRIDE_CPU_CAPS", "LP_NATIVE_VECTOR_WIDTH"};
// The names of x86-64 and of arm64.
constexpr std::array<std::string_view, 6> kKindLines{"vendor_id", "cpu family", "model",
                                                     "flags",     "CPU ",       "Features"};

std::filesystem::path cacheHome() {
  const auto absolute = [](const char* variable) -> std::filesystem::path {
    const char* value = std::getenv(variable);
    const std::filesystem::path path = value == nullptr ? "" : value;
    return path.is_absolute() ? path : std::filesystem::path();
  };
  if (const std::filesystem::path cache = absolute("XDG_CACHE_HOME"); !cache.empty()) return cache;
  const std::filesystem::path home = absolute("HOME");
  return home.empty() ? home : home / ".cache";
}

}  // namespace

std::string processorKind(std::istream& cpuinfo) {
  std::string kind;
  for (std::string line; std::getline(cpuinfo, line) && !line.empty();)
    if (std::any_of(kKindLines.begin(), kKindLines.end(),
                    [&](std::string_view name) { return line.starts_with(name); }))
      kind += line + '\n';
  return kind;
}

std::optional<std::filesystem::path> shaderCacheFolder() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  std::string kind = processorKind(cpuinfo);
  const std::filesystem::path home = cacheHome();
  if (kind.empty() || home.empty()) return std::nullopt;
  for (const char* name : kMesaVariables) {
    const char* value = std::getenv(name);
    kind += std::string(name) + '=' + (value == nullptr ? "" : value) + '\n';
  }
  const std::filesystem::path folder =
      home / "carom" / ("shaders-" + std::to_string(std::hash<std::string>{}(kind)));
  std::error_code none;
  std::filesystem::create_directories(folder, none);  // Mesa makes one level only, and complains
  if (access(folder.c_str(), W_OK | X_OK) != 0) return std::nullopt;
  return folder;
}

}  // namespace carom::renderer
