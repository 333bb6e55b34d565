/// Completion in fish: one `complete` line per flag, conditional on its subcommand.

#include "common/base/command/pages.h"

namespace seam {
namespace {

std::string QuotedForFish(const std::string& text) {
  std::string out = "'";
  for (const char c : text)
    out += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out + "'";
}

std::string Joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
  return all;
}

/// Returns " -s o -l output" for "-o", "--output".
std::string Names(const FlagEntry& flag) {
  std::string names;
  for (const std::string& name : flag.names) {
    const bool is_long = name.rfind("--", 0) == 0;
    names += is_long ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  return names;
}

void AddCommand(const CommandEntry& command, const std::string& program,
                const std::string& condition, std::string* script) {
  const std::string begin =
      "complete -c " + program + (condition.empty() ? "" : " -n " + QuotedForFish(condition));
  for (const FlagEntry& flag : command.flags) {
    const std::string values =
        flag.values.empty() ? "" : " -a " + QuotedForFish(Joined(flag.values));
    if (flag.names.empty()) {
      if (!values.empty()) *script += begin + values + " -d " + QuotedForFish(flag.word) + "\n";
      continue;
    }
    std::string line = begin + Names(flag);
    if (flag.takes_value) line += values.empty() ? " -r" : " -x" + values;
    *script += line + " -d " + QuotedForFish(flag.about) + "\n";
  }
  for (const CommandEntry& sub : command.commands) {
    const std::string here = condition.empty() ? "__fish_use_subcommand" : condition;
    *script += "complete -c " + program + " -n " + QuotedForFish(here) + " -a " + sub.name +
               " -d " + QuotedForFish(sub.about) + "\n";
    AddCommand(sub, program, "__fish_seen_subcommand_from " + sub.name, script);
  }
}

}  // namespace

std::string FishCompletion(const CommandEntry& program) {
  std::string script = "# made by " + program.name + " --generate fish\n";
  AddCommand(program, program.name, "", &script);
  return script;
}

}  // namespace seam
