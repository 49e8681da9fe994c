#include "demos/shell_completion.h"

#include <sstream>

namespace carom::demos {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string optionWords(const std::vector<OptionDescription>& options) {
  std::vector<std::string> words;
  for (const OptionDescription& option : options) words.push_back(option.names.back());
  return joined(words, " ");
}

bool takesScene(const CommandDescription& command) {
  return !command.arguments.empty() && command.arguments[0].names[0].rfind("SCENE", 0) == 0;
}

/// What follows an option that takes a value: one of its choices, or a file's name for all bash can know.
std::string valueCases(const CommandDescription& command) {
  std::string chosen;
  std::vector<std::string> free;
  for (const OptionDescription& option : command.options) {
    if (!option.takes_value) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : option.names) patterns.push_back(command.name + "," + name);
    if (option.choices.empty())
      free.insert(free.end(), patterns.begin(), patterns.end());
    else
      chosen += "    " + joined(patterns, "|") + ") COMPREPLY=($(compgen -W '" + joined(option.choices, " ") +
                "' -- \"$word\")); return ;;\n";
  }
  return free.empty() ? chosen : chosen + "    " + joined(free, "|") + ") return ;;\n";
}

std::string wordsCase(const CommandDescription& command) {
  return "    " + command.name + ") options='" + optionWords(command.options) +
         (takesScene(command) ? "' scenes=yes ;;\n" : "' ;;\n");
}

}  // namespace

std::string bashCompletion(const ProgramDescription& program) {
  std::vector<std::string> names;
  std::string values, words;
  for (const CommandDescription& command : program.commands) {
    names.push_back(command.name);
    values += valueCases(command);
    words += wordsCase(command);
  }
  std::ostringstream script;
  script << "# bash completion of carom " << program.version << ", written by the program itself.\n"
         << R"bash(_carom() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} options= scenes=
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W ')bash"
         << joined(names, " ") << ' ' << optionWords(program.options) << R"bash(' -- "$word"))
    return
  fi
  case ${COMP_WORDS[1]},$previous in
)bash" << values
         << R"bash(  esac
  case ${COMP_WORDS[1]} in
)bash" << words
         << R"bash(  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  elif [ -n "$scenes" ] && [ "$COMP_CWORD" -eq 2 ]; then
    COMPREPLY=($(compgen -W "$("${COMP_WORDS[0]}" list 2>/dev/null | cut -d' ' -f1)" -- "$word"))
  fi
}
complete -o bashdefault -o default -F _carom carom
)bash";
  return script.str();
}

}  // namespace carom::demos
