#include "demos/cli/command_line.h"

#include <algorithm>
#include <iostream>
#include <sstream>
#include <vector>

#include "demos/cli/command_options.h"
#include "demos/cli/given_values.h"
#include "demos/cli/manual_page.h"
#include "demos/cli/shell_completion.h"
#include "demos/format/nearest_name.h"
#include "demos/overlay/overlay_choice.h"
#include "demos/system/build_info.h"

namespace carom::demos {
namespace {

std::string quotedCommandLine(int argc, char** argv) {
  std::string text = "carom";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool plain = !word.empty() && word.find_first_of(" \t\"'\\$&|;<>()*?#") == std::string::npos;
    text += plain ? " " + word : " '" + word + "'";
  }
  return text;
}

std::vector<std::string> optionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The words of "TEXT:{json,none,auto}", CLI11's name for a value that is one of a few.
std::vector<std::string> choicesIn(const std::string& type) {
  std::vector<std::string> words;
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return words;
  std::istringstream in(type.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

OptionDescription described(const CLI::Option& option) {
  OptionDescription description;
  for (const std::string& name : option.get_snames()) description.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) description.names.push_back("--" + name);
  if (description.names.empty()) description.names.push_back(option.get_name(true));
  description.takes_value = !option.get_positional() && option.get_expected_max() > 0;
  description.choices = choicesIn(option.get_type_name());
  description.text = option.get_description();
  return description;
}

CommandDescription described(const CLI::App& command) {
  CommandDescription description{command.get_name(), command.get_description(), {}, {}, command.get_footer()};
  for (const CLI::Option* option : command.get_options())
    (option->get_positional() ? description.arguments : description.options).push_back(described(*option));
  return description;
}

ProgramDescription describedProgram(const CLI::App& app) {
  ProgramDescription program{app.get_name(), programVersion(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) program.options.push_back(described(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    program.commands.push_back(described(*command));
  return program;
}

/// Words that nothing wanted: a misspelt command or option, or one argument too many.
void refuseExtras(const CommandLine& line) {
  const std::vector<CLI::App*> chosen = line.app.get_subcommands();
  if (chosen.empty()) {
    std::vector<std::string> names;
    for (const CLI::App* command : line.app.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(command->get_name());
    const std::vector<std::string> extras = line.app.remaining();
    if (extras.empty()) throw UsageError("a command is missing" + acceptedNames("", names));
    if (extras[0][0] == '-')
      throw UsageError("unknown option " + extras[0] + acceptedNames(extras[0], optionNames(line.app)));
    throw UsageError("unknown command \"" + extras[0] + "\"" + acceptedNames(extras[0], names));
  }
  std::vector<std::string> extras = line.app.remaining(true);
  std::erase(extras, "--");  // what follows it is no option, and has been taken as that
  if (extras.empty()) return;
  const std::string word = extras[0].substr(0, extras[0].find('='));
  const std::string name = chosen[0]->get_name();
  if (word[0] == '-')
    throw UsageError(name + ": unknown option " + word + acceptedNames(word, optionNames(*chosen[0])));
  throw UsageError(name + ": unexpected argument \"" + word + "\"");
}

std::string helpOf(const CommandLine& line, const std::string& name) {
  // Of an application that has parsed a command, help is that command's.
  if (name.empty()) return CommandLine().app.help();
  std::vector<std::string> names;
  for (const CLI::App* command : line.app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == name) return command->help("carom");
    names.push_back(command->get_name());
  }
  throw UsageError("help: unknown command \"" + name + "\"" + acceptedNames(name, names));
}

std::string oneLine(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

}  // namespace

std::optional<ExitCode> readCommandLine(CommandLine& line, int argc, char** argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  try {
    line.app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const std::vector<CLI::App*> chosen = line.app.get_subcommands();
    std::cout << (chosen.empty() ? line.app.help() : chosen[0]->help("carom"));
    return ExitCode::kOk;
  } catch (const CLI::CallForVersion& version) {
    std::cout << version.what() << '\n';
    return ExitCode::kOk;
  } catch (const CLI::ParseError& error) {
    // A misspelt or an empty word is the better reason when there is one.
    refuseExtras(line);
    for (const CLI::App* command : line.app.get_subcommands()) refuseEmptyValues(*command, words);
    throw UsageError(oneLine(error.what()));
  }
  if (line.wants_manual || line.wants_completion || line.wants_zsh || line.wants_fish) {
    const ProgramDescription program = describedProgram(line.app);
    std::cout << (line.wants_manual       ? manualPage(program)
                  : line.wants_completion ? bashCompletion(program)
                  : line.wants_zsh        ? zshCompletion(program)
                                          : fishCompletion(program));
    return ExitCode::kOk;
  }
  refuseExtras(line);
  refuseEmptyValues(*line.app.get_subcommands().at(0), words);
  if (line.help_command->parsed()) {
    std::cout << helpOf(line, line.help_of);
    return ExitCode::kOk;
  }
  if (line.version_command->parsed()) {
    std::cout << line.app.version() << '\n';
    return ExitCode::kOk;
  }
  if (line.render_options.overlays == "help") {
    std::cout << overlayHelp();
    return ExitCode::kOk;
  }
  checkValues(line);
  return std::nullopt;
}

ExitCode runCommandLine(int argc, char** argv) {
  CommandLine line;
  if (const std::optional<ExitCode> code = readCommandLine(line, argc, argv)) return *code;
  for (int i = 1; i < argc; ++i) line.budget_options.words.emplace_back(argv[i]);
  const RenderOptions& asked = line.render_options;
  line.render_options.caption =
      line.caption.empty() ? !asked.portable && asked.background == "scene" : line.caption == "on";
  line.render_options.states = line.render_options.states || line.render_options.portable;
  line.render_options.command_line = quotedCommandLine(argc, argv);
  if (line.list_command->parsed()) return list(line.list_options);
  if (line.render_command->parsed()) return render(line.render_options);
  if (line.simulate_command->parsed()) return simulate(line.simulate_options);
  if (line.export_command->parsed()) return exportMotion(line.export_options);
  if (line.check_command->parsed()) return check(line.check_options);
  if (line.distance_command->parsed()) return distance(line.distance_options);
  if (line.compare_command->parsed()) return compare(line.compare_options);
  if (line.regress_command->parsed()) return regress(line.regress_options);
  if (line.budget_command->parsed()) return budget(line.budget_options);
  if (line.figures_command->parsed()) return figures(line.figures_options);
  if (line.gallery_command->parsed()) return gallery(line.gallery_options);
  if (line.new_command->parsed()) return newScene(line.new_options);
  return doctor(line.doctor_options);
}

}  // namespace carom::demos
