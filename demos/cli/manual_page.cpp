#include "demos/cli/manual_page.h"

#include <sstream>

namespace carom::demos {
namespace {

constexpr char kExitStatus[] =
    R"(.TP
.B 0
All is well.
.TP
.B 1
The answer is no: images differ, a budget is broken, a hash is not the expected one.
.TP
.B 2
The command line makes no sense.
.TP
.B 3
A scene, mesh, recording or image cannot be used.
.TP
.B 4
Something cannot be written.
.TP
.B 5
The simulation became invalid.
.TP
.B 6
There is no renderer; see
.BR "carom doctor" .
.TP
.B 7
The budget is inconclusive: too much noise.
.TP
.B 128+n
Ended by signal n; 141: nobody reads standard output.
)";

/// A line of text that troff takes literally.
std::string escapedLine(const std::string& line) {
  std::string text;
  if (!line.empty() && (line[0] == '.' || line[0] == '\'')) text = "\\&";
  for (const char c : line) {
    if (c == '\\')
      text += "\\e";
    else if (c == '-')
      text += "\\-";
    else
      text += c;
  }
  return text;
}

/// Several lines, each ended.
std::string escaped(const std::string& text) {
  std::istringstream in(text);
  std::string all;
  for (std::string line; std::getline(in, line);) all += escapedLine(line) + "\n";
  return all;
}

std::string entry(const OptionDescription& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + name;
  std::string values;
  for (const std::string& choice : option.choices) values += (values.empty() ? "" : "|") + choice;
  if (option.takes_value) names.append(" ").append(values.empty() ? "VALUE" : values);
  std::string text = ".TP\n\\fB";
  return text.append(escapedLine(names)).append("\\fR\n").append(escaped(option.text));
}

std::string commandSection(const CommandDescription& command) {
  std::string text = ".SS " + command.name + "\n" + escaped(command.text);
  for (const OptionDescription& argument : command.arguments) text += entry(argument);
  for (const OptionDescription& option : command.options) text += entry(option);
  if (!command.example.empty()) text += ".PP\n.nf\n" + escaped(command.example) + ".fi\n";
  return text;
}

}  // namespace

std::string manualPage(const ProgramDescription& program) {
  std::string text = ".TH CAROM 1 \"\" \"carom " + escapedLine(program.version) + "\" \"User Commands\"\n";
  text += ".SH NAME\ncarom \\- rigid bodies, simulated and drawn without a display\n";
  text += ".SH SYNOPSIS\n.B carom\n.I COMMAND\n[\\fIARGUMENT\\fR ...] [\\fIOPTION\\fR ...]\n";
  text += ".SH DESCRIPTION\n" + escaped(program.text);
  text += "Data goes to standard output, progress and messages to standard error.\n.SH OPTIONS\n";
  for (const OptionDescription& option : program.options) text += entry(option);
  text += ".SH COMMANDS\n";
  for (const CommandDescription& command : program.commands) text += commandSection(command);
  return text + ".SH EXIT STATUS\n" + kExitStatus;
}

}  // namespace carom::demos
