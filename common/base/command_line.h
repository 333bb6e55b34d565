#pragma once
/// The command line of a program: its flags and subcommands, --help, --version, and one clear line
/// with status 2 for a mistake. For mains. CLI11 stays behind common/base/command/.

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/base/command/command_table.h"

namespace CLI {
class Option;
}  // namespace CLI

namespace seam {

/// A flag or positional word that was just added; its limits are stated in a chain.
class Flag {
 public:
  explicit Flag(CLI::Option* option) : option_(option) {}
  Flag& Range(int low, int high);
  Flag& Range(float low, float high);
  Flag& Range(double low, double high);
  Flag& OneOf(const std::vector<std::string>& words);
  Flag& OneOfOrRange(const std::vector<std::string>& words, float low, float high);
  /// The program is refused without it.
  Flag& Required();
  /// Takes one value each time it is given: a positional word may follow.
  Flag& OneValueEach();
  /// Splits its value at commas.
  Flag& CommaSeparated();

 private:
  friend class Command;
  CLI::Option* option_;
};

/// A program or one of its subcommands. What is added must outlive the parsing.
class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}

  /// Adds a flag ("-o,--output") or positional word ("SCENE") that takes a value.
  Flag Option(const std::string& names, std::string& value, const std::string& about);
  Flag Option(const std::string& names, int& value, const std::string& about);
  Flag Option(const std::string& names, std::int64_t& value, const std::string& about);
  Flag Option(const std::string& names, float& value, const std::string& about);
  Flag Option(const std::string& names, double& value, const std::string& about);
  Flag Option(const std::string& names, std::optional<int>& value, const std::string& about);
  Flag Option(const std::string& names, std::optional<double>& value, const std::string& about);
  Flag Option(const std::string& names, std::vector<std::string>& values, const std::string& about);
  /// Adds a flag without a value, which sets `value`; "!--no-floor" clears it.
  void Switch(const std::string& names, bool& value, const std::string& about);
  /// Adds a subcommand. It lives as long as this.
  Command& Add(const std::string& name, const std::string& about);
  /// Refuses the program without one subcommand.
  void RequireCommand();
  /// Requires these flags, in this order, if none of this command's own subcommands was named.
  void RequireWithoutCommand(const std::vector<Flag>& flags);
  /// True if this command was named, after parsing.
  bool chosen() const;

 private:
  CLI::App* app_;
  std::deque<Command> commands_;
};

struct ProgramText {
  const char* name;     ///< "seam-server"
  std::string about;    ///< the first line of --help
  std::string version;  ///< what --version prints
  std::string footer;   ///< the last lines of --help
  FlagValues values{};  ///< completions of flags whose values are names of ours
};

/// Parses the command line as `define` says, then returns `run()`, within RunMain. --help (of a
/// subcommand too) and --version print to stdout and return 0 without running; so does
/// `--generate man|bash|zsh|fish` alone, which `make docs` calls.
int RunCommandLine(const ProgramText& text, int argc, const char* const* argv,
                   const std::function<void(Command&)>& define, const std::function<int()>& run);

}  // namespace seam
