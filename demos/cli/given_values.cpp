#include "demos/cli/given_values.h"

#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {

/// An option or argument that names what is written.
struct Output {
  const char* name;
  bool is_text;  ///< It may go to standard output.
};
// `render -o -` is a stream, which has rules of its own.
constexpr Output kOutputs[] = {{"OUT", false},  {"output", false}, {"ffmpeg", false}, {"csv", true},
                               {"npy", false},  {"audit", true},   {"json", true},    {"trace", true},
                               {"plot", false}, {"report", false}, {"junit", false},  {"differences", false}};
constexpr const char* kInputs[] = {"from", "mesh", "baseline"};

/// "-o", "--csv", "SCENE"
std::string shownName(const CLI::Option& option) {
  if (option.get_positional()) return option.get_single_name();
  return option.get_snames().empty() ? "--" + option.get_single_name() : "-" + option.get_snames()[0];
}

bool takesValue(const CLI::Option& option) {
  return option.get_expected_max() > 0;
}

}  // namespace

void refuseEmptyValues(const CLI::App& command, std::span<const std::string> words) {
  for (const std::string& word : words) {
    if (word == "--") break;
    if (word.starts_with("--") && word.find('=') == word.size() - 1)
      throw UsageError(command.get_name() + ": " + word.substr(0, word.size() - 1) + " is empty");
  }
  for (const CLI::Option* option : command.get_options())
    for (const std::string& value : option->results())
      if (value.empty()) throw UsageError(command.get_name() + ": " + shownName(*option) + " is empty");
}

std::vector<NamedFile> writtenFiles(const CLI::App& command) {
  std::vector<NamedFile> files;
  for (const CLI::Option* option : command.get_options())
    for (const Output& output : kOutputs) {
      if (option->get_single_name() != output.name || !takesValue(*option)) continue;
      for (const std::string& value : option->results()) {
        const bool is_none = option->get_single_name() == "report" && value == "none";
        const bool is_stream = option->get_single_name() == "output" && command.get_name() == "render";
        if (value == kStandardOutput && !output.is_text && !is_stream)
          throw UsageError(shownName(*option) + " -: this does not go to standard output; accepted: a name");
        if (!is_none) files.push_back({shownName(*option), value});
      }
    }
  requireDistinct(files);
  return files;
}

std::vector<NamedFile> readFiles(const CLI::App& command) {
  std::vector<NamedFile> files;
  for (const CLI::Option* option : command.get_options())
    for (const char* input : kInputs)
      if (option->get_single_name() == input)
        for (const std::string& value : option->results()) files.push_back({shownName(*option), value});
  return files;
}

}  // namespace carom::demos
