/// Completion in zsh: one function per command, which passes its flags to _arguments.

#include "common/base/command/pages.h"

namespace seam {
namespace {

/// Escapes text for single quotes of the shell and for the brackets and colons of _arguments.
std::string QuotedForZsh(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
      out += std::string("\\") + c;
    } else {
      out += c;
    }
  }
  return out;
}

std::string Values(const FlagEntry& flag) {
  if (flag.values.empty()) return "_files";
  std::string all;
  for (const std::string& value : flag.values)
    all += (all.empty() ? "" : " ") + QuotedForZsh(value);
  return "(" + all + ")";
}

/// Returns the lines of _arguments for a command's flags and words.
std::string Arguments(const CommandEntry& command) {
  std::string lines;
  for (const FlagEntry& flag : command.flags) {
    for (const std::string& name : flag.names) {
      lines += "    '*" + name + "[" + QuotedForZsh(flag.about) + "]";
      lines += (flag.takes_value ? ":value:" + Values(flag) : "") + "' \\\n";
    }
    // A scene may be a file as well as a name.
    if (flag.names.empty() && flag.values.empty()) {
      lines += "    '*:" + QuotedForZsh(flag.word) + ":_files' \\\n";
    } else if (flag.names.empty()) {
      lines += "    '*:" + QuotedForZsh(flag.word) + ":{compadd - " +
               QuotedForZsh(Values(flag).substr(1));
      lines.pop_back();
      lines += "; _files}' \\\n";
    }
  }
  return lines;
}

void AddFunction(const CommandEntry& command, const std::string& function, std::string* script) {
  for (const CommandEntry& sub : command.commands) {
    AddFunction(sub, function + "_" + sub.name, script);
  }
  *script += function + "() {\n";
  if (command.commands.empty()) {
    *script += "  _arguments -s \\\n" + Arguments(command) + "    && return 0\n}\n";
    return;
  }
  *script += "  local -a commands=(\n";
  for (const CommandEntry& sub : command.commands) {
    *script += "    '" + sub.name + ":" + QuotedForZsh(sub.about) + "'\n";
  }
  *script += "  )\n  if (( CURRENT > 2 )); then\n    case \"$words[2]\" in\n";
  for (const CommandEntry& sub : command.commands) {
    *script += "      " + sub.name + ") shift words; (( CURRENT-- )); " + function + "_" +
               sub.name + "; return;;\n";
  }
  *script += "    esac\n  fi\n  _describe command commands\n  _arguments -s \\\n" +
             Arguments(command) + "    && return 0\n}\n";
}

}  // namespace

std::string ZshCompletion(const CommandEntry& program) {
  std::string script =
      "#compdef " + program.name + "\n# made by " + program.name + " --generate zsh\n";
  AddFunction(program, "_" + program.name, &script);
  return script + "_" + program.name + " \"$@\"\n";
}

}  // namespace seam
