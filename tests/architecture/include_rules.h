#pragma once
// Which file may include what: the floors of the engine low to high, the renderer beside them, the demos on
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

/// The engine's floors with their height; equal heights must not see each other.
inline const std::map<std::string, int>& floorHeights() {
  static const std::map<std::string, int> heights{
      {"foundation", 0},  {"solid", 1},   {"closest_features", 2}, {"motion", 2}, {"broad_phase", 2},
      {"environment", 3}, {"contact", 3}, {"response", 4},         {"modes", 5},  {"simulation", 6}};
  return heights;
}

/// A third-party library: how its headers begin, and the files that may name them.
struct Library {
  const char* name;
  const char* header_prefix;
  std::vector<std::string> files;
};

inline const std::vector<Library>& guardedLibraries() {
  static const std::vector<Library> libraries{{"GL", "GL/", {"renderer/gl_functions.h"}},
                                              {"EGL", "EGL/", {"renderer/egl_context.cpp"}},
                                              {"ISA-L", "isa-l", {"renderer/quick_deflate.cpp"}},
                                              {"libpng", "png", {"renderer/png.cpp"}},
                                              {"Cairo", "cairo", {"renderer/canvas.cpp"}},
                                              {"assimp", "assimp/", {"demos/mesh_import.cpp"}},
                                              {"tinygltf", "tiny_gltf.h", {"demos/motion_gltf.cpp"}},
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

/// Why `path` must not include our own header `header`; empty when it may.
inline std::string arrowProblem(const std::string& path, const std::string& header) {
  const std::vector<std::string> from = partsOf(path), to = partsOf(header);
  if (to.size() < 2 || (to[0] != "engine" && to[0] != "renderer" && to[0] != "demos"))
    return "is not named by its path from the root of the tree";
  if (from[0] == "demos") return "";
  if (to[0] == "demos") return "only demos may see demos";
  if (from[0] == "renderer") {
    const bool low = to[0] == "renderer" || to[1] == "foundation" || to[1] == "solid";
    return low ? "" : "the renderer sees foundation and solid only";
  }
  if (to[0] == "renderer") return "the engine must not see the renderer";
  const auto& heights = floorHeights();
  if (from.size() < 3 || !heights.contains(from[1])) return "stands on no known floor";
  if (to.size() < 3 || !heights.contains(to[1])) return "leads to no known floor";
  if (from[1] == to[1] || heights.at(to[1]) < heights.at(from[1])) return "";
  return heights.at(to[1]) == heights.at(from[1]) ? "points sideways" : "points up";
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

}  // namespace carom::architecture
