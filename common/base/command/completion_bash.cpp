/// Completion in bash: one function per program. It finds the subcommand among the words typed so
/// far, then completes the previous flag's value, or a flag, or a word.

#include "common/base/command/pages.h"

namespace seam {
namespace {

std::string Joined(const std::vector<std::string>& words, const char* between) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
  return all;
}

/// Returns "_seam_lab" for "seam-lab".
std::string FunctionName(const std::string& program) {
  std::string name = "_";
  for (const char c : program) name += c == '-' ? '_' : c;
  return name;
}

/// Writes the cases "COMMAND WORDBEFORE)" for flags that take a value.
void AddValues(const CommandEntry& command, const std::string& path, std::string* script) {
  for (const FlagEntry& flag : command.flags) {
    if (flag.names.empty() || !flag.takes_value) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : flag.names) patterns.push_back("'" + path + " " + name + "'");
    *script += "    " + Joined(patterns, "|") + ") ";
    *script += flag.values.empty() ? "files=1" : "words='" + Joined(flag.values, " ") + "'";
    *script += ";;\n";
  }
  for (const CommandEntry& sub : command.commands) AddValues(sub, path + "/" + sub.name, script);
}

/// Writes the cases "COMMAND)" for everything else: flags, subcommands, positional words.
void AddWords(const CommandEntry& command, const std::string& path, std::string* script) {
  std::vector<std::string> words = FlagNames(command);
  for (const CommandEntry& sub : command.commands) words.push_back(sub.name);
  bool files = false;
  for (const FlagEntry& flag : command.flags) {
    if (!flag.names.empty()) continue;
    words.insert(words.end(), flag.values.begin(), flag.values.end());
    files = true;
  }
  *script += "    '" + path + "') words='" + Joined(words, " ") + "'";
  *script += std::string(files ? "; files=1" : "") + ";;\n";
  for (const CommandEntry& sub : command.commands) AddWords(sub, path + "/" + sub.name, script);
}

/// Writes the cases "COMMAND WORD)" that lead to a subcommand.
void AddCommands(const CommandEntry& command, const std::string& path, std::string* script) {
  for (const CommandEntry& sub : command.commands) {
    const std::string next = path + "/" + sub.name;
    *script += "      '" + path + " " + sub.name + "') at='" + next + "';;\n";
    AddCommands(sub, next, script);
  }
}

}  // namespace

std::string BashCompletion(const CommandEntry& program) {
  const std::string function = FunctionName(program.name);
  std::string script =
      "# bash completion of " + program.name + "; made by " + program.name + " --generate bash\n" +
      function + "() {\n" + "  local at=. words='' files='' i\n" +
      "  local word=\"${COMP_WORDS[COMP_CWORD]}\"\n" +
      "  local before=\"${COMP_WORDS[COMP_CWORD-1]}\"\n" +
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n" + "    case \"$at ${COMP_WORDS[i]}\" in\n";
  AddCommands(program, ".", &script);
  script += "      *) ;;\n    esac\n  done\n  case \"$at $before\" in\n";
  AddValues(program, ".", &script);
  script += "    *) case \"$at\" in\n";
  AddWords(program, ".", &script);
  script += "    esac;;\n  esac\n  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n";
  script += "  [ -z \"$files\" ] || COMPREPLY+=($(compgen -f -- \"$word\"))\n}\n";
  return script + "complete -o filenames -F " + function + " " + program.name + "\n";
}

}  // namespace seam
