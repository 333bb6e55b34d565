#pragma once
/// A program's flags as data: the source of its man page, shell completion and "did you mean".
/// Read from the command line's parser, so that no flag can be missing.

#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace seam {

struct FlagEntry {
  std::vector<std::string> names;   ///< "-o", "--output"; empty for a positional word
  std::string word;                 ///< placeholder of a positional word: "SCENE"
  std::string about;                ///< one line
  bool takes_value = false;         ///< the next word is its value
  bool required = false;            ///< without it the command is refused
  std::vector<std::string> values;  ///< allowed values, if they are a list
};

struct CommandEntry {
  std::string name;   ///< "seam-lab", "run"
  std::string about;  ///< one line
  std::vector<FlagEntry> flags;
  std::vector<CommandEntry> commands;  ///< subcommands
};

/// Values by a flag's last name or a positional word: `{{"--impair", {"perfect", "demo"}}}`.
using FlagValues = std::map<std::string, std::vector<std::string>>;

/// Returns everything that `app` parses: subcommands, --help and --version too. A flag's values
/// come from the first of these that has some: `values`, its check, its text ("script | bot").
CommandEntry TableOf(const CLI::App& app, const FlagValues& values);

/// Returns all flag names of a command without its subcommands': "-o", "--output".
std::vector<std::string> FlagNames(const CommandEntry& command);

/// Returns the words separated by bars: {"own", "all"} for "predict: own | all (default all)".
/// Empty if there is no bar.
std::vector<std::string> WordsBetweenBars(const std::string& text);

}  // namespace seam
