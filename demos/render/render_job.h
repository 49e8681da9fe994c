#pragma once
// Renders a scene: which frames, of whose motion, as files, a stream or a moving picture, by one process or
// several. The command reads the options; everything else is here, for whoever links it. Tested in
// tests/demos/program/program_test.cpp, tests/demos/render/long_jobs_test.cpp and
// tests/demos/program/workers_program_test.cpp.

#include <filesystem>
#include <optional>
#include <string>

#include "demos/format/telling.h"
#include "demos/language/scene_choice.h"
#include "demos/system/exit_code.h"

namespace carom::demos {

struct RenderOptions {
  SceneChoice choice;
  std::string output;  ///< Empty: frames/<scene>/frame_%04d.png; "-" with `stream`.
  std::string frames;  ///< "0-99,150,200-300x5"; empty: all.
  std::string shard;   ///< "i/n"; empty: the whole.
  bool resume = false;
  std::string stream;            ///< ppm, png, rgb24, or empty.
  std::filesystem::path from;    ///< A recording instead of simulating.
  std::filesystem::path moving;  ///< A moving picture instead of frames.
  std::string sheet;             ///< "4x3": a contact sheet instead of frames; empty: none.
  double fps = 30.0;
  double speed = 1.0;          ///< Of the scene's time over the frames'.
  std::optional<double> at_s;  ///< One still at this time instead of frames.
  int width = 1280;
  int height = 720;
  std::string camera;  ///< Empty: "main", else the first.
  std::string preset = "realtime";
  std::string style = "daylight";
  std::string light;                 ///< Empty: the scene's.
  std::optional<double> exposure;    ///< None: the light's.
  std::string background = "scene";  ///< "none": neither sky nor ground, and alpha.
  double shutter_degrees = 0.0;      ///< Of a turn a frame that the shutter is open; 0: it closes at once.
  std::string aov;                   ///< "depth,normal,id"; empty: none.
  std::string overlays;              ///< "closest,distance"; empty: none.
  std::string focus;                 ///< The bodies that overlays speak of, "cube,floor"; empty: all.
  bool caption = true;               ///< The scene's, where it has one.
  bool portable = false;             ///< The same pixels on every CPU.
  bool states = false;               ///< A record beside the frames, by which `compare` names causes.
  std::string gl = "auto";
  int workers = 0;  ///< Processes that draw; 0: as many as are usual.
  Telling telling;
  std::string command_line;  ///< As typed, for the manifest.
};
ExitCode render(const RenderOptions& options);

}  // namespace carom::demos
