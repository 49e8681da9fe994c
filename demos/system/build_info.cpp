#include "demos/system/build_info.h"

namespace carom::demos {

std::string programVersion() {
  return CAROM_VERSION;
}

std::string buildName() {
#if defined(__clang__)
  const std::string compiler =
      "clang " + std::to_string(__clang_major__) + "." + std::to_string(__clang_minor__);
#else
  const std::string compiler = "gcc " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__);
#endif
  return compiler + ", " CAROM_BUILD_TYPE;
}

std::vector<std::pair<std::string, std::string>> libraryVersions() {
  return {{"Eigen", CAROM_EIGEN_VERSION},       {"assimp", CAROM_ASSIMP_VERSION},
          {"libpng", CAROM_PNG_VERSION},        {"qhull", CAROM_QHULL_VERSION},
          {"CLI11", CAROM_CLI11_VERSION},       {"nlohmann-json", CAROM_JSON_VERSION},
          {"tinygltf", CAROM_TINYGLTF_VERSION}, {"cairo", CAROM_CAIRO_VERSION}};
}

std::string cpuClass() {
#if defined(__x86_64__)
  std::string name = "x86-64";
  if (__builtin_cpu_supports("avx512f")) return name + " avx512";
  if (__builtin_cpu_supports("avx2")) name += " avx2";
  if (__builtin_cpu_supports("fma")) name += " fma";
  return name;
#else
  return "not x86-64";
#endif
}

}  // namespace carom::demos
