#pragma once
/// The flags of a program as data: the one source of its man page, of its completion in shells and
/// of "did you mean". Taken from what parses the command line, so that none can be missing.

#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace seam {

struct FlagEntry {
  std::vector<std::string> names;   ///< "-o", "--output"; empty for a positional word
  std::string word;                 ///< what stands for a positional word: "SCENE"
  std::string about;                ///< one line
  bool takes_value = false;         ///< the next word belongs to it
  bool required = false;            ///< without it the command is refused
  std::vector<std::string> values;  ///< what the value may be, as far as it is a list
};

struct CommandEntry {
  std::string name;   ///< "seam-lab", "run"
  std::string about;  ///< one line
  std::vector<FlagEntry> flags;
  std::vector<CommandEntry> commands;  ///< subcommands
};

/// Values by a flag's last name or a positional word: `{{"--impair", {"perfect", "demo"}}}`.
using FlagValues = std::map<std::string, std::vector<std::string>>;

/// What `app` parses, subcommands included, --help and --version too. The values of a flag are, in
/// this order: of `values`; of its check; those that its text lists as "script | bot".
CommandEntry TableOf(const CLI::App& app, const FlagValues& values);

/// All names of the flags of a command, without its subcommands': "-o", "--output".
std::vector<std::string> FlagNames(const CommandEntry& command);

/// The words that a text lists with bars: "own | all" of "what to predict: own | all (default
/// all)". Empty if there is none.
std::vector<std::string> WordsBetweenBars(const std::string& text);

}  // namespace seam
