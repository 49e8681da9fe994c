#pragma once
// The program's commands and options as plain values: what the manual page and the shell completion are
// written from, so that neither can fall behind. command_line.cpp fills it in.

#include <string>
#include <vector>

namespace carom::demos {

struct OptionDescription {
  std::vector<std::string> names;    ///< "-q", "--quiet"; of a positional argument its name alone: "SCENE".
  bool takes_value = false;          ///< Of options: followed by a value.
  std::vector<std::string> choices;  ///< The values, where they are a few words.
  std::string text;
};

struct CommandDescription {
  std::string name;
  std::string text;
  std::vector<OptionDescription> arguments;
  std::vector<OptionDescription> options;
  std::string example;  ///< A few lines.
};

struct ProgramDescription {
  std::string name;
  std::string version;
  std::string text;
  std::vector<OptionDescription> options;
  std::vector<CommandDescription> commands;
};

}  // namespace carom::demos
