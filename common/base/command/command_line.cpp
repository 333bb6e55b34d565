#include "common/base/command_line.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "common/base/command/mistake.h"
#include "common/base/command/pages.h"
#include "common/base/process.h"
#include "common/base/version.h"

namespace seam {
namespace {

/// Returns a line for the word that compares with nothing, and so passes every range; else "".
std::string ANumber(const std::string& text) {
  double value = 0;
  const bool nan = CLI::detail::lexical_cast(text, value) && std::isnan(value);
  return nan ? text + " is not a number" : "";
}

/// Returns a line for a word without letters, as an unset variable of a shell makes one; else "".
std::string SomeText(const std::string& text) { return text.empty() ? "has an empty value" : ""; }

}  // namespace

Flag& Flag::Range(int low, int high) { return option_->check(CLI::Range(low, high)), *this; }
Flag& Flag::Range(float low, float high) { return option_->check(CLI::Range(low, high)), *this; }
Flag& Flag::Range(double low, double high) { return option_->check(CLI::Range(low, high)), *this; }

Flag& Flag::OneOf(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return *this;
}

Flag& Flag::OneOfOrRange(const std::vector<std::string>& words, float low, float high) {
  option_->check(CLI::IsMember(words) | CLI::Range(low, high));
  return *this;
}

Flag& Flag::Required() { return option_->required(), *this; }
Flag& Flag::OneValueEach() { return option_->allow_extra_args(false), *this; }
Flag& Flag::CommaSeparated() { return option_->delimiter(','), *this; }

Flag Command::Option(const std::string& names, std::string& value, const std::string& about) {
  return Flag(app_->add_option(names, value, about)->check(SomeText));
}
Flag Command::Option(const std::string& names, int& value, const std::string& about) {
  return Flag(app_->add_option(names, value, about));
}
Flag Command::Option(const std::string& names, std::int64_t& value, const std::string& about) {
  return Flag(app_->add_option(names, value, about));
}
Flag Command::Option(const std::string& names, float& value, const std::string& about) {
  return Flag(app_->add_option(names, value, about)->check(ANumber));
}
Flag Command::Option(const std::string& names, double& value, const std::string& about) {
  return Flag(app_->add_option(names, value, about)->check(ANumber));
}
Flag Command::Option(const std::string& names, std::optional<int>& value,
                     const std::string& about) {
  return Flag(app_->add_option(names, value, about));
}
Flag Command::Option(const std::string& names, std::optional<double>& value,
                     const std::string& about) {
  return Flag(app_->add_option(names, value, about)->check(ANumber));
}
Flag Command::Option(const std::string& names, std::vector<std::string>& values,
                     const std::string& about) {
  return Flag(app_->add_option(names, values, about)->check(SomeText));
}

void Command::Switch(const std::string& names, bool& value, const std::string& about) {
  app_->add_flag(names, value, about);
}

Command& Command::Add(const std::string& name, const std::string& about) {
  return commands_.emplace_back(app_->add_subcommand(name, about));
}

void Command::RequireCommand() { app_->require_subcommand(1); }

void Command::RequireWithoutCommand(const std::vector<Flag>& flags) {
  app_->callback([app = app_, flags] {
    if (!app->get_subcommands().empty()) return;
    for (const Flag& flag : flags) {
      if (flag.option_->empty()) throw CLI::RequiredError(flag.option_->get_name());
    }
  });
}

bool Command::chosen() const { return app_->parsed(); }

int RunCommandLine(const ProgramText& text, int argc, const char* const* argv,
                   const std::function<void(Command&)>& define, const std::function<int()>& run) {
  return RunMain(text.name, [&] {
    CLI::App app(text.about, text.name);
    app.footer(text.footer);
    app.set_version_flag("--version", text.version);
    Command program(&app);
    define(program);
    if (argc == 3 && std::string(argv[1]) == "--generate") {
      const std::string page =
          GeneratedPage(argv[2], TableOf(app, text.values), {kVersion, text.footer});
      std::fputs(page.c_str(), stdout);
      return std::fflush(stdout) == 0 ? 0 : 1;
    }
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& help) {
      return app.exit(help);
    } catch (const CLI::ParseError& e) {
      throw OperatorError(CommandMistake(app, e) + "; see " + text.name + " --help");
    }
    return run();
  });
}

}  // namespace seam
