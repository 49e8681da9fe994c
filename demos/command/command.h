#pragma once
// The commands of the program with their options as plain values; each lives in command_<name>.cpp, `render`
// in render_job.cpp. They write data to stdout and everything else to stderr, and report failure by the
// exceptions that main.cpp maps to exit codes.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "demos/format/telling.h"
#include "demos/language/scene_choice.h"
#include "demos/record/trajectory_files.h"
#include "demos/render/render_job.h"
#include "demos/system/exit_code.h"

namespace carom::demos {

struct ListOptions {
  bool json = false;
};
ExitCode list(const ListOptions& options);

struct SimulateOptions {
  SceneChoice choice;
  double fps = 30.0;             ///< Of the trajectory and of the recording.
  std::filesystem::path output;  ///< The recording.
  TrajectoryPaths trajectory;
  std::filesystem::path audit;  ///< "-": standard output.
  std::string expected_hash;
  Telling telling;
};
ExitCode simulate(const SimulateOptions& options);

struct ExportOptions {
  SceneChoice choice;            ///< `scene` may be a recording.
  std::filesystem::path moved;   ///< Where the recording's scene is now.
  std::filesystem::path output;  ///< A .glb or .html file; empty: none.
  TrajectoryPaths trajectory;
  std::optional<double> fps;  ///< None: 30, of a page 60, or the recording's.
  Telling telling;
};
ExitCode exportMotion(const ExportOptions& options);

struct CheckOptions {
  SceneChoice choice;  ///< `scene` may be a mesh file.
};
ExitCode check(const CheckOptions& options);

struct NewOptions {
  std::filesystem::path output;
};
/// Writes a scene with comments that say what can be changed; never over a file that is there.
ExitCode newScene(const NewOptions& options);

/// Either two meshes and their poses, or a batch.
struct DistanceOptions {
  std::string mesh_a;
  std::string mesh_b;
  std::string pose_a;  ///< "x,y,z" or "x,y,z,qw,qx,qy,qz"; empty: identity.
  std::string pose_b;
  std::string batch;  ///< A file of JSON lines, "-" for standard input, or empty.
  bool cold = false;
};
ExitCode distance(const DistanceOptions& options);

struct CompareOptions {
  std::filesystem::path actual;  ///< Two files or two folders.
  std::filesystem::path golden;
  int tolerance = 2;    ///< Of 8-bit images, in steps of 1/255.
  int tolerance16 = 0;  ///< Of 16-bit images, in steps of 1/65535.
  std::int64_t allowed_pixels = 0;
  std::string report;  ///< Empty: compare-report.html, and only when a pair does not pass; "none": never.
  int report_pairs = 20;
  std::filesystem::path differences;  ///< Folder of difference images; empty: none.
  int amplify = 16;
  std::filesystem::path junit;
  bool json = false;
  bool update = false;
  std::vector<std::string> accepted;  ///< Names of pairs: an update of these alone.
  bool undo = false;                  ///< Of the last update.
  std::vector<std::string> masks;     ///< See picture_mask.h.
  Telling telling;
};
ExitCode compare(const CompareOptions& options);

struct RegressOptions {
  std::filesystem::path suite;  ///< A folder with suite.json, or such a file.
  std::filesystem::path output = "regress-out";
  int jobs = 0;  ///< Scenes at a time; 0: one for each processor.
  bool json = false;
  std::filesystem::path junit;
  bool update = false;
  Telling telling;
};
ExitCode regress(const RegressOptions& options);

struct BudgetOptions {
  SceneChoice choice;
  double budget_ms = 16.7;
  double percentile = 99.0;
  int replays = 5;
  double fps = 60.0;
  int width = 1280;
  int height = 720;
  std::string camera;
  std::string preset = "realtime";
  std::string light;  ///< Empty: the scene's.
  std::string json;   ///< A file, "-" for standard output, or empty; so are the next two.
  std::string csv;
  std::string trace;
  std::filesystem::path plot;  ///< .svg or .html; empty: none.
  std::filesystem::path baseline;
  double tolerance_percent = 10.0;
  double work_tolerance_percent = 0.0;
  std::string clock = "wall";      ///< Or "cpu".
  std::string against;             ///< Another carom with options of its own, as a command line.
  bool paced = false;              ///< Draws a frame a line of standard input.
  std::vector<std::string> words;  ///< As typed, for the other program.
  std::string gl = "auto";
  Telling telling;
};
ExitCode budget(const BudgetOptions& options);

struct FiguresOptions {
  std::filesystem::path output = "figures";  ///< A folder.
  int width = 1280;
  int height = 720;
};
ExitCode figures(const FiguresOptions& options);

struct GalleryOptions {
  std::vector<std::string> scenes;           ///< Names or files; empty: all that are shipped.
  std::filesystem::path output = "gallery";  ///< A folder.
  int width = 480;                           ///< Of the moving pictures, as the next.
  int height = 270;
  double fps = 15.0;
  int jobs = 0;       ///< Scenes at a time; 0: one for each processor.
  bool part = false;  ///< Makes one scene's files and tells of them: what it starts for each.
  std::string gl = "auto";
  Telling telling;
};
ExitCode gallery(const GalleryOptions& options);

struct DoctorOptions {
  std::string gl = "auto";  ///< What must draw; "auto": the first that serves, and the other is told of.
};
ExitCode doctor(const DoctorOptions& options);

}  // namespace carom::demos
