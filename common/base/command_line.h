#pragma once
/// Command-line handling of all mains: parses the flags and prints help and version. A mistake
/// gives one line and exit status 2. Include it in mains only: it brings CLI11.

#include <CLI/CLI.hpp>
#include <string>

#include "common/base/command/command_table.h"
#include "common/base/command/mistake.h"
#include "common/base/command/pages.h"
#include "common/base/process.h"
#include "common/base/version.h"

namespace seam {

struct ProgramText {
  const char* name;     ///< "seam-server"
  std::string about;    ///< the first line of --help
  std::string version;  ///< printed by --version
  std::string footer;   ///< the last lines of --help
  FlagValues values{};  ///< completions for flags that take one of our names
};

/// Parses the command line as `define(CLI::App&)` says, then returns `run()`, within RunMain.
/// --help (also of a subcommand) and --version print to stdout and return 0 without running. So
/// does `--generate man|bash|zsh|fish` as the only flag; `make docs` calls it.
template <typename Define, typename Run>
int RunCommandLine(const ProgramText& text, int argc, const char* const* argv, Define define,
                   Run run) {
  return RunMain(text.name, [&] {
    CLI::App app(text.about, text.name);
    app.footer(text.footer);
    app.set_version_flag("--version", text.version);
    define(app);
    if (argc == 3 && std::string(argv[1]) == "--generate") {
      const std::string page =
          GeneratedPage(argv[2], TableOf(app, text.values), {kVersion, text.footer});
      std::fputs(page.c_str(), stdout);
      return std::fflush(stdout) == 0 ? 0 : 1;
    }
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& wish) {
      return app.exit(wish);
    } catch (const CLI::ParseError& e) {
      throw OperatorError(CommandMistake(app, e) + "; see " + text.name + " --help");
    }
    return run();
  });
}

}  // namespace seam
