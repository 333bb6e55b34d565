#include "common/scene/toml/toml_hint.h"

#include <regex.h>

#include <cstddef>
#include <optional>
#include <string>

#include "common/base/check.h"
#include "common/scene/toml/scene_text.h"

namespace seam {
namespace {

std::string LineOfText(const std::string& text, int line) {
  std::size_t begin = 0;
  for (int i = 1; i < line && begin != std::string::npos; ++i) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  if (begin == std::string::npos || begin > text.size()) return "";
  std::string found = text.substr(begin, text.find('\n', begin) - begin);
  constexpr std::size_t kLongestLooked = 400;  // no people write longer ones
  if (found.size() > kLongestLooked) return "";
  if (!found.empty() && found.back() == '\r') found.pop_back();
  const std::size_t first = found.find_first_not_of(" \t");
  return first == std::string::npos ? "" : found.substr(first);
}

/// A slip: the form of a line, a POSIX extended regular expression with GNU's \w, \s and \b, and
/// its remedy, in which $1 is a part of the line.
struct Slip {
  const char* form;
  const char* remedy;
  const char* unless = nullptr;  ///< a form that is no such slip
};

/// Ordered: the first form that is in the line counts.
constexpr Slip kSlips[] = {
    {"\xe2\x80(\x9c|\x9d|\x9e|\x98|\x99)", "quotes are plain ones: \" or '"},
    {"^\\[\\[[[:alnum:]_.-]+\\]?$", "a table of a list ends with two brackets: [[part]]"},
    {"^\\[[[:alnum:]_.-]+$", "a table's name ends with a bracket: [solver]"},
    {"^([[:alnum:]_-]+)\\s*:", "write $1 = ..., with = and not :"},
    {"^([[:alnum:]_-]+)\\s+[[\"'0-9-]", "there is no = behind $1"},
    {"=\\s*(-?[0-9]+),([0-9]+)\\s*(#.*)?$", "a decimal point, not a comma: $1.$2"},
    {"=\\s*\\(([^()]*)\\)", "square brackets: [$1]"},
    {"\\[[^]]*;", "a comma between numbers, not a semicolon"},
    {"[[,=]\\s*(-?[0-9]+(\\.[0-9]+)?)\\s*(\xc2\xb0|deg|degrees)",
     "angles are in radians and have no unit: 180 degrees are 3.1416"},
    {"[[,=]\\s*(-?[0-9]+(\\.[0-9]+)?)\\s*[A-Za-z%]+", "numbers have no unit: $1"},
    {"=\\s*(True|False|TRUE|FALSE|yes|no|on|off|Yes|No|On|Off)\\s*(#.*)?$",
     "say true or false, in small letters"},
    {"[[,=]\\s*(-?)(\\.[0-9]+)", "a digit before the point: $10$2"},
    {"[[,=]\\s*(-?[0-9]+)\\.([^0-9]|$)", "a digit behind the point: $1.0"},
    {"[[,=]\\s*(-?)0+([1-9][0-9]*)\\s*([],}#]|$)", "no zeros before a number: $1$2"},
    {"\\[\\s*-?[0-9]+(\\.[0-9]+)?(,[0-9]+)?\\s+-?[0-9]",
     "a comma between numbers, and a decimal point"},
    {"=\\s*([A-Za-z_][[:alnum:]_-]*)\\s*(#.*)?$", "text stands in quotes: \"$1\"",
     "=\\s*(true|false|inf|nan)\\b"},
    {"=\\s*(\"[^\"]*\"|'[^']*'|[[:alnum:]_.+-]+|\\[[^][]*\\])\\s+[^[:space:]#]",
     "one value, and nothing behind it on its line"},
    {"=\\s*(#.*)?$", "there is no value behind ="},
};

/// The whole and the parts $1 to $9 of what has the form.
constexpr std::size_t kMatchParts = 10;
struct Match {
  std::string parts[kMatchParts];
};

std::optional<Match> Find(const char* form, const std::string& line) {
  regex_t compiled;
  SEAM_ASSERT(regcomp(&compiled, form, REG_EXTENDED) == 0);
  regmatch_t places[kMatchParts];
  const bool found = regexec(&compiled, line.c_str(), kMatchParts, places, 0) == 0;
  regfree(&compiled);
  if (!found) return std::nullopt;
  Match match;
  for (std::size_t i = 0; i < kMatchParts; ++i) {
    if (places[i].rm_so < 0) continue;
    match.parts[i].assign(line, static_cast<std::size_t>(places[i].rm_so),
                          static_cast<std::size_t>(places[i].rm_eo - places[i].rm_so));
  }
  return match;
}

std::string Filled(const char* remedy, const Match& match) {
  std::string text;
  for (const char* c = remedy; *c != '\0'; ++c) {
    if (*c == '$') {
      text += match.parts[*++c - '0'];
    } else {
      text += *c;
    }
  }
  return text;
}

}  // namespace

std::string TomlHint(const std::string& text, int line) {
  const std::string found = LineOfText(text, line);
  if (found.empty()) return "";
  for (const Slip& slip : kSlips) {
    const std::optional<Match> match = Find(slip.form, found);
    if (!match || (slip.unless != nullptr && Find(slip.unless, found))) continue;
    std::string shown = found.substr(0, found.find(" #"));
    shown.erase(shown.find_last_not_of(" \t") + 1);
    return Printable(shown) + ": " + Filled(slip.remedy, *match);
  }
  return "";
}

}  // namespace seam
