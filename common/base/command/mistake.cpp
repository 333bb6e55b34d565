#include "common/base/command/mistake.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "common/base/command/command_table.h"
#include "common/base/nearest.h"

namespace seam {
namespace {

bool IsFlag(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

std::vector<std::string> CommandNames(const CommandEntry& table) {
  std::vector<std::string> names;
  for (const CommandEntry& command : table.commands) names.push_back(command.name);
  return names;
}

/// Returns the innermost command on the command line: `gait` of `seam-lab tune gait`.
const CLI::App& Innermost(const CLI::App& app) {
  const std::vector<const CLI::App*> parsed =
      app.get_subcommands([](const CLI::App* sub) { return sub->parsed(); });
  return parsed.empty() ? app : Innermost(*parsed.back());
}

/// Appends the probable correction to "--drive: scrpt not in {script,bot}".
std::string WithSuggestion(const std::string& text) {
  const std::string mark = " not in {";
  const std::size_t at = text.find(mark), from = text.find(": "), end = text.find('}');
  if (at == std::string::npos || from == std::string::npos || end == std::string::npos) return text;
  std::vector<std::string> known;
  std::istringstream in(text.substr(at + mark.size(), end - at - mark.size()));
  for (std::string word; std::getline(in, word, ',');) known.push_back(word);
  return text + DidYouMean(text.substr(from + 2, at - from - 2), known);
}

}  // namespace

std::string CommandMistake(const CLI::App& app, const CLI::ParseError& e) {
  const std::vector<std::string> rest = app.remaining(true);
  const CLI::App& command = Innermost(app);
  const CommandEntry table = TableOf(command, {});
  const auto flag = std::find_if(rest.begin(), rest.end(), IsFlag);
  if (flag != rest.end()) {
    const std::string name = flag->substr(0, flag->find('='));
    const std::string where = &command == &app ? "" : " of " + command.get_name();
    return "there is no flag " + name + where + DidYouMean(name, FlagNames(table));
  }
  if (!rest.empty() && !table.commands.empty()) {
    const std::string& name = rest.front();
    return "there is no subcommand '" + name + "' (" + Suggestion(name, CommandNames(table)) + ")";
  }
  return WithSuggestion(e.what());
}

}  // namespace seam
