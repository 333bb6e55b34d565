#include "common/base/command/command_table.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace seam {
namespace {

/// Returns the members listed in a check's text, "{script,bot}": CLI11 offers no other way to read
/// the values that a check accepts.
std::vector<std::string> WordsInBraces(const std::string& text) {
  const std::size_t begin = text.find('{'), end = text.find('}');
  std::vector<std::string> words;
  if (begin == std::string::npos || end == std::string::npos || end < begin) return words;
  std::istringstream in(text.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

std::vector<std::string> ValuesOf(const CLI::Option& option, const FlagEntry& flag,
                                  const FlagValues& values) {
  const std::string& name = flag.names.empty() ? flag.word : flag.names.back();
  const auto given = values.find(name);
  if (given != values.end()) return given->second;
  const std::vector<std::string> checked = WordsInBraces(option.get_type_name());
  return checked.empty() ? WordsBetweenBars(flag.about) : checked;
}

FlagEntry EntryOf(const CLI::Option& option, const FlagValues& values) {
  FlagEntry flag;
  for (const std::string& name : option.get_snames()) flag.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) flag.names.push_back("--" + name);
  if (flag.names.empty()) flag.word = option.get_name(true);
  flag.about = option.get_description();
  flag.takes_value = option.get_type_size_max() > 0 && option.get_items_expected_max() > 0;
  flag.required = option.get_required();
  if (flag.takes_value) flag.values = ValuesOf(option, flag, values);
  return flag;
}

}  // namespace

std::vector<std::string> WordsBetweenBars(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> all{std::istream_iterator<std::string>(in), {}}, words;
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    if (all[i] != "|") continue;
    if (words.empty()) words.push_back(all[i - 1]);
    words.push_back(all[i + 1]);
  }
  return words;
}

CommandEntry TableOf(const CLI::App& app, const FlagValues& values) {
  CommandEntry command;
  command.name = app.get_name();
  command.about = app.get_description();
  for (const CLI::Option* option : app.get_options()) {
    command.flags.push_back(EntryOf(*option, values));
  }
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    command.commands.push_back(TableOf(*sub, values));
  }
  return command;
}

std::vector<std::string> FlagNames(const CommandEntry& command) {
  std::vector<std::string> names;
  for (const FlagEntry& flag : command.flags) {
    names.insert(names.end(), flag.names.begin(), flag.names.end());
  }
  return names;
}

}  // namespace seam
