#pragma once
// Which file may include what: the folders of the engine low to high, those of the renderer, of the demos on
// top, and one file for each third-party library. A file is judged from its path and its text alone.

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace carom::architecture {

struct Source {
  std::string path;  ///< From the root of the tree, with forward slashes.
  std::string text;
};

/// The folders with their heights. A file includes its own folder and lower ones; equal heights must not see
/// each other.
inline const std::map<std::string, int>& folderHeights() {
  static const std::map<std::string, int> heights{{"engine/foundation", 0},
                                                  {"engine/solid", 1},
                                                  {"engine/closest_features/pair", 2},
                                                  {"engine/solid/decomposition", 2},
                                                  {"engine/closest_features/penetrating", 3},
                                                  {"engine/closest_features/separated", 4},
                                                  {"engine/broad_phase", 5},
                                                  {"engine/closest_features", 5},
                                                  {"engine/motion", 5},
                                                  {"engine/contact", 6},
                                                  {"engine/environment", 6},
                                                  {"engine/response/one_point", 7},
                                                  {"engine/response/sweeps", 8},
                                                  {"engine/response", 9},
                                                  {"engine/modes", 10},
                                                  {"engine/simulation/bodies", 11},
                                                  {"engine/simulation/contacts", 12},
                                                  {"engine/simulation/events", 13},
                                                  {"engine/simulation", 14},
                                                  {"renderer/image", 20},
                                                  {"renderer/look", 21},
                                                  {"renderer/view", 22},
                                                  {"renderer/mesh", 23},
                                                  {"renderer/drawing", 24},
                                                  {"renderer/gl", 25},
                                                  {"renderer/draw", 26},
                                                  {"renderer/passes", 27},
                                                  {"renderer/frame", 28},
                                                  {"demos/format", 40},
                                                  {"demos/formula", 41},
                                                  {"demos/system", 41},
                                                  {"demos/asset", 42},
                                                  {"demos/scene", 43},
                                                  {"demos/language", 44},
                                                  {"demos/cause", 45},
                                                  {"demos/compare", 46},
                                                  {"demos/record", 47},
                                                  {"demos/motion", 48},
                                                  {"demos/frames", 49},
                                                  {"demos/video", 50},
                                                  {"demos/overlay", 51},
                                                  {"demos/budget", 52},
                                                  {"demos/against", 53},
                                                  {"demos/page", 54},
                                                  {"demos/report", 54},
                                                  {"demos/regress", 55},
                                                  {"demos/render", 56},
                                                  {"demos/gallery", 57},
                                                  {"demos/figure", 57},
                                                  {"demos/command", 58},
                                                  {"demos/cli", 59},
                                                  {"demos", 60}};
  return heights;
}

/// A third-party library: how its headers begin, and the files that may name them.
struct Library {
  const char* name;
  const char* header_prefix;
  std::vector<std::string> files;
};

inline const std::vector<Library>& guardedLibraries() {
  static const std::vector<Library> libraries{
      {"GL", "GL/", {"renderer/gl/gl_functions.h"}},
      {"EGL", "EGL/", {"renderer/gl/egl_context.cpp"}},
      {"ISA-L", "isa-l", {"renderer/image/quick_deflate.cpp"}},
      {"libpng", "png", {"renderer/image/png.cpp"}},
      {"Cairo", "cairo", {"renderer/drawing/canvas.cpp"}},
      {"libjpeg", "jpeglib.h", {"demos/asset/jpeg_picture.cpp"}},
      {"assimp", "assimp/", {"demos/asset/mesh_import.cpp"}},
      {"tinygltf", "tiny_gltf.h", {"demos/asset/assimp_file.cpp", "demos/record/motion_gltf.cpp"}},
      {"qhull", "libqhull", {"engine/solid/convex_hull.cpp"}}};
  return libraries;
}

inline std::vector<std::string> partsOf(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream in(path);
  for (std::string part; std::getline(in, part, '/');) parts.push_back(part);
  return parts;
}

struct Include {
  int line;
  std::string header;
  bool quoted;
};

inline std::vector<Include> includesOf(const std::string& text) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  std::vector<Include> includes;
  std::istringstream in(text);
  int line = 0;
  for (std::string row; std::getline(in, row);) {
    ++line;
    if (std::smatch match; std::regex_match(row, match, pattern))
      includes.push_back({line, match[2], match[1] == "\""});
  }
  return includes;
}

/// The folder of a file, without a slash behind it.
inline std::string folderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// Why `path` must not include our own header `header`; empty when it may.
inline std::string arrowProblem(const std::string& path, const std::string& header) {
  const std::vector<std::string> from = partsOf(path), to = partsOf(header);
  if (to.size() < 2 || (to[0] != "engine" && to[0] != "renderer" && to[0] != "demos"))
    return "is not named by its path from the root of the tree";
  if (from[0] != "demos" && to[0] == "demos") return "only demos may see demos";
  if (from[0] == "renderer" && to[0] == "engine" && to[1] != "foundation" && to[1] != "solid")
    return "the renderer sees foundation and solid only";
  if (from[0] == "engine" && to[0] == "renderer") return "the engine must not see the renderer";
  const auto& heights = folderHeights();
  std::string own = folderOf(path), other = folderOf(header);
  if (!heights.contains(own)) return "stands on no known floor";
  if (!heights.contains(other)) return "leads to no known floor";
  // From one floor of the engine to another it is their own heights that count, not those of their rooms.
  if (from[0] == "engine" && to[0] == "engine" && from[1] != to[1]) {
    own = "engine/" + from[1];
    other = "engine/" + to[1];
  }
  if (own == other || heights.at(other) < heights.at(own)) return "";
  return heights.at(other) == heights.at(own) ? "points sideways" : "points up";
}

/// Why `path` must not include the library header `header`; empty when it may.
inline std::string libraryProblem(const std::string& path, const std::string& header) {
  for (const Library& library : guardedLibraries()) {
    if (!header.starts_with(library.header_prefix)) continue;
    if (std::find(library.files.begin(), library.files.end(), path) == library.files.end())
      return std::string("only ") + library.files[0] + " may name " + library.name;
    return "";
  }
  if (header.starts_with("nlohmann/") && !path.starts_with("demos/")) return "only the demos read JSON";
  const bool standard = header.find_first_of("/.") == std::string::npos;
  if (path.starts_with("engine/") && !standard && !header.starts_with("Eigen/"))
    return "the engine stands on Eigen and the standard library";
  return "";
}

/// One line for each include that breaks a rule: "path:line: header: reason".
inline std::vector<std::string> violations(const std::vector<Source>& sources) {
  std::vector<std::string> found;
  std::vector<std::string> json_files;
  for (const Source& source : sources)
    for (const auto& [line, header, quoted] : includesOf(source.text)) {
      const std::string problem =
          quoted ? arrowProblem(source.path, header) : libraryProblem(source.path, header);
      if (!problem.empty())
        found.push_back(source.path + ":" + std::to_string(line) + ": " + header + ": " + problem);
      const bool known = !json_files.empty() && json_files.back() == source.path;
      if (header.starts_with("nlohmann/") && !known) json_files.push_back(source.path);
    }
  for (std::size_t i = 1; i < json_files.size(); ++i)
    found.push_back(json_files[i] + ": the JSON library is already named by " + json_files[0]);
  return found;
}

/// No folder holds more sources: more are two concepts.
inline constexpr int kMostSources = 20;

/// One line for each folder that holds too many.
inline std::vector<std::string> overfullFolders(const std::vector<std::string>& paths) {
  std::map<std::string, int> counts;
  for (const std::string& path : paths) ++counts[folderOf(path)];
  std::vector<std::string> found;
  for (const auto& [folder, count] : counts)
    if (count > kMostSources)
      found.push_back(folder + " holds " + std::to_string(count) + " sources, more than " +
                      std::to_string(kMostSources));
  return found;
}

}  // namespace carom::architecture
