#pragma once
// Options that several commands take. Tested through the program in tests/demos/program/program_test.cpp.

#include <string>

#include <CLI/CLI.hpp>

#include "demos/command/command.h"

namespace carom::demos {

inline constexpr int kMostWorkers = 64;

void addMeshOptions(CLI::App& command, SceneChoice& choice);
void addSettings(CLI::App& command, SceneChoice& choice);
void addSceneOptions(CLI::App& command, SceneChoice& choice);
void addThreadsOption(CLI::App& command, SceneChoice& choice);
void addTellingOptions(CLI::App& command, Telling& telling);
void addGlOption(CLI::App& command, std::string& gl);
void addLightOption(CLI::App& command, std::string& light);
void addPresetOption(CLI::App& command, std::string& preset);
void addTrajectoryOptions(CLI::App& command, TrajectoryPaths& paths);

}  // namespace carom::demos
