#include <sstream>

#include "common/base/check.h"
#include "common/base/command/pages.h"
#include "common/base/nearest.h"

namespace seam {
namespace {

/// Escapes text for roff: backslashes, dashes (so that they can be copied) and characters that
/// would begin a request.
std::string Roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  if (!out.empty() && (out[0] == '.' || out[0] == '\'')) out = "\\&" + out;
  return out;
}

std::string Upper(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

void AddFlags(const CommandEntry& command, std::string* page) {
  for (const FlagEntry& flag : command.flags) {
    std::string names;
    for (const std::string& name : flag.names) {
      names += (names.empty() ? "\\fB" : ", \\fB") + Roff(name) + "\\fR";
    }
    if (flag.names.empty()) names = "\\fI" + Roff(flag.word) + "\\fR";
    if (!flag.names.empty() && flag.takes_value) names += " \\fIVALUE\\fR";
    *page +=
        ".TP\n" + names + "\n" + Roff(flag.about) + (flag.required ? " (required)" : "") + "\n";
  }
}

void AddCommand(const CommandEntry& command, const std::string& path, std::string* page) {
  *page += ".SS " + Roff(path) + "\n" + Roff(command.about) + "\n";
  AddFlags(command, page);
  for (const CommandEntry& sub : command.commands) AddCommand(sub, path + " " + sub.name, page);
}

std::string Synopsis(const CommandEntry& program) {
  std::string line = ".B " + Roff(program.name) + "\n";
  if (!program.commands.empty()) line += ".I SUBCOMMAND\n";
  for (const FlagEntry& flag : program.flags) {
    if (flag.names.empty()) line += "[\\fI" + Roff(flag.word) + "\\fR]\n";
  }
  return line + "[\\fIOPTIONS\\fR]\n";
}

/// Returns the text unfilled, line by line.
std::string Verbatim(const std::string& text) {
  std::string out = ".nf\n";
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    out += line.empty() ? ".sp\n" : Roff(line) + "\n";
  }
  return out + ".fi\n";
}

}  // namespace

std::string ManPage(const CommandEntry& program, const PageText& text) {
  std::string about = program.about;
  const std::string prefix = program.name + ": ";
  if (about.rfind(prefix, 0) == 0) about = about.substr(prefix.size());
  std::string page = ".TH " + Roff(Upper(program.name)) + " 1 \"\" \"Seam2D " + Roff(text.version) +
                     "\" \"Seam2D\"\n.SH NAME\n" + Roff(program.name) + " \\- " + Roff(about) +
                     "\n.SH SYNOPSIS\n" + Synopsis(program) + ".SH OPTIONS\n";
  AddFlags(program, &page);
  if (!program.commands.empty()) page += ".SH SUBCOMMANDS\n";
  for (const CommandEntry& sub : program.commands) AddCommand(sub, sub.name, &page);
  if (!text.footer.empty()) page += ".SH NOTES\n" + Verbatim(text.footer);
  return page +
         ".SH EXIT STATUS\n0: done. 1: not all could be done, as the last line says.\n"
         "2: the command cannot be done as it was given; nothing was written.\n";
}

std::string GeneratedPage(const std::string& kind, const CommandEntry& program,
                          const PageText& text) {
  if (kind == "man") return ManPage(program, text);
  if (kind == "bash") return BashCompletion(program);
  if (kind == "zsh") return ZshCompletion(program);
  if (kind == "fish") return FishCompletion(program);
  throw OperatorError("--generate takes man, bash, zsh or fish, not '" + kind + "'" +
                      DidYouMean(kind, {"man", "bash", "zsh", "fish"}));
}

}  // namespace seam
