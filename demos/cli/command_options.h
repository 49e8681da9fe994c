#pragma once
// All commands with their options and the places their values go. Tested through the program in
// tests/demos/program/program_test.cpp.

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "demos/command/command.h"
#include "demos/system/exit_code.h"

namespace carom::demos {

/// Everything that can be asked for, with the places its values go.
struct CommandLine {
  CLI::App app{"Carom: impulse-based rigid bodies on V-Clip, drawn off screen to PNG frames.", "carom"};
  ListOptions list_options;
  RenderOptions render_options;
  SimulateOptions simulate_options;
  ExportOptions export_options;
  CheckOptions check_options;
  DistanceOptions distance_options;
  CompareOptions compare_options;
  RegressOptions regress_options;
  BudgetOptions budget_options;
  FiguresOptions figures_options;
  GalleryOptions gallery_options;
  DoctorOptions doctor_options;
  NewOptions new_options;
  bool wants_manual = false;
  bool wants_completion = false;
  bool wants_zsh = false;
  bool wants_fish = false;
  std::string help_of;
  std::string size;
  std::string caption;
  std::string budget_size;
  std::string figures_size;
  std::string gallery_size;
  std::string budget_tolerance;
  std::string budget_work_tolerance;
  CLI::App* list_command = nullptr;
  CLI::App* render_command = nullptr;
  CLI::App* simulate_command = nullptr;
  CLI::App* export_command = nullptr;
  CLI::App* check_command = nullptr;
  CLI::App* distance_command = nullptr;
  CLI::App* compare_command = nullptr;
  CLI::App* regress_command = nullptr;
  CLI::App* budget_command = nullptr;
  CLI::App* figures_command = nullptr;
  CLI::App* gallery_command = nullptr;
  CLI::App* doctor_command = nullptr;
  CLI::App* new_command = nullptr;
  CLI::App* help_command = nullptr;
  CLI::App* version_command = nullptr;

  CommandLine();
  void addRender();
  void addLongJobOptions();
  void addLookOptions();
  void addOverlayOptions();
  void addSimulate();
  void addExport();
  void addDistance();
  void addCompare();
  void addRegress();
  void addBudget();
  void addFigures();
  void addGallery();
  void groupOptions();
};

/// What is left to do when all is read: what one option says of another, and the ranges of numbers. Throws
/// UsageError.
void checkValues(CommandLine& line);

/// Reads the words into `line`; gives a code where they only asked for a text (help, a version, a manual),
/// which is then told on standard output. Throws UsageError.
std::optional<ExitCode> readCommandLine(CommandLine& line, int argc, char** argv);

}  // namespace carom::demos
