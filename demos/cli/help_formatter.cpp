#include "demos/cli/help_formatter.h"

#include <string>
#include <utility>

namespace carom::demos {
namespace {

/// Later versions would break the lines of footers anew.
template <typename Formatter>
void keepLines(Formatter& formatter) {
  if constexpr (requires { formatter.enable_footer_formatting(false); }) {
    formatter.enable_footer_formatting(false);
    formatter.enable_description_formatting(false);
  }
}

class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() {
    label("POSITIONALS", "Positionals");
    label("SUBCOMMANDS", "Subcommands");
    keepLines<CLI::Formatter>(*this);
  }
  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string usage = CLI::Formatter::make_usage(app, std::move(name));
    usage.erase(0, usage.find_first_not_of('\n'));
    return (usage.starts_with("Usage:") ? "" : "Usage: ") + usage;
  }
};

}  // namespace

std::shared_ptr<CLI::Formatter> helpFormatter() {
  return std::make_shared<HelpFormatter>();
}

void headOtherOptions(CLI::App& command) {
  for (CLI::Option* option : command.get_options([](const CLI::Option*) { return true; }))
    if (option->get_group() == "OPTIONS") option->group("Options");
  for (CLI::App* inner : command.get_subcommands([](const CLI::App*) { return true; }))
    headOtherOptions(*inner);
}

}  // namespace carom::demos
