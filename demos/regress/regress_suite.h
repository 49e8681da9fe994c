#pragma once
// A suite of scenes whose frames are held against golden ones: one file that says how each is drawn.
//   { "render": ["--portable", "--size", "320x180"],          what all scenes are drawn with
//     "compare": ["--tolerance", "2"],                         and compared with
//     "scenes": [ "sliding",                                    a shipped scene, golden frames in sliding/
//                 { "name": "slow", "scene": "my.json", "render": ["--speed", "0.1"], "golden": "slow" } ] }
// Files and folders are relative to the suite's. Tested in tests/demos/program/regress_program_test.cpp.

#include <filesystem>
#include <string>
#include <vector>

namespace carom::demos {

inline constexpr char kSuiteName[] = "suite.json";

struct SuiteScene {
  std::string name;   ///< Of its folder of frames and its row in the index.
  std::string scene;  ///< A shipped scene's name or a file.
  std::filesystem::path golden;
  std::vector<std::string> render;  ///< All options, those of the suite first.
  std::vector<std::string> compare;
};

struct RegressSuite {
  std::filesystem::path file;
  std::vector<SuiteScene> scenes;
};

/// The suite in `folder`, or the file itself. Throws InputError with the place.
RegressSuite readSuite(const std::filesystem::path& path);

}  // namespace carom::demos
