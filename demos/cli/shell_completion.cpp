#include "demos/cli/shell_completion.h"

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

/// The first line of a description, without what a quoted word of zsh or fish gives a meaning.
std::string plainLine(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  for (char& c : line)
    if (c == '\'' || c == '\\') c = ' ';
  return line;
}

/// Within [...] of a zsh specification, brackets and colons are written with a stroke before them.
std::string zshText(const std::string& text) {
  std::string escaped;
  for (const char c : plainLine(text)) {
    if (c == '[' || c == ']' || c == ':') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// '(-q --quiet)'{-q,--quiet}'[text]:value:(a b)' or with files for what zsh cannot know.
std::string zshOption(const OptionDescription& option) {
  std::string specification =
      option.names.size() == 1 ? option.names[0]
                               : "'(" + joined(option.names, " ") + ")'{" + joined(option.names, ",") + "}";
  const std::string value = !option.takes_value      ? ""
                            : option.choices.empty() ? ":value:_files"
                                                     : ":value:(" + joined(option.choices, " ") + ")";
  return "        " + specification + "'[" + zshText(option.text) + "]" + value + "'";
}

std::string zshCase(const CommandDescription& command) {
  std::string text = "    " + command.name + ")\n      _arguments";
  for (const OptionDescription& option : command.options) text += " \\\n" + zshOption(option);
  if (takesScene(command))
    text += " \\\n        '1:scene:_carom_scenes' '*:file:_files'\n";
  else
    text += " \\\n        '*:file:_files'\n";
  return text + "      ;;\n";
}

std::string fishOption(const std::string& condition, const OptionDescription& option) {
  std::string line = "complete -c carom -n '" + condition + "'";
  for (const std::string& name : option.names)
    line += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.takes_value)
    line += option.choices.empty() ? " -r -F" : " -x -a '" + joined(option.choices, " ") + "'";
  return line + " -d '" + plainLine(option.text) + "'\n";
}

}  // namespace

std::string zshCompletion(const ProgramDescription& program) {
  std::string commands, cases, options;
  for (const CommandDescription& command : program.commands) {
    commands += "    '" + command.name + ":" + zshText(command.text) + "'\n";
    cases += zshCase(command);
  }
  for (const OptionDescription& option : program.options) options += " " + option.names.back();
  return "#compdef carom\n# zsh completion of carom " + program.version +
         ", written by the program itself.\n"
         "_carom_scenes() {\n"
         "  local -a scenes\n"
         "  scenes=(${(f)\"$(${words[1]:-carom} list 2>/dev/null | cut -d' ' -f1)\"})\n"
         "  compadd -a scenes\n"
         "  _files\n"
         "}\n"
         "_carom() {\n"
         "  local -a commands\n"
         "  commands=(\n" +
         commands +
         "  )\n"
         "  if (( CURRENT == 2 )); then\n"
         "    _describe command commands\n"
         "    compadd --" +
         options +
         "\n    return\n"
         "  fi\n"
         "  local command=${words[2]}\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $command in\n" +
         cases +
         "  esac\n"
         "}\n"
         "_carom \"$@\"\n";
}

std::string fishCompletion(const ProgramDescription& program) {
  const std::string none = "__fish_use_subcommand";
  std::string text = "# fish completion of carom " + program.version + ", written by the program itself.\n";
  for (const OptionDescription& option : program.options) text += fishOption(none, option);
  for (const CommandDescription& command : program.commands) {
    const std::string within = "__fish_seen_subcommand_from " + command.name;
    text += "complete -c carom -f -n '" + none + "' -a " + command.name + " -d '" + plainLine(command.text) +
            "'\n";
    for (const OptionDescription& option : command.options) text += fishOption(within, option);
    if (takesScene(command))
      text +=
          "complete -c carom -n '" + within + "' -a '(carom list 2>/dev/null | string split -f 1 \" \")'\n";
  }
  return text;
}

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
