#include "common/scene/toml/toml_hint.h"

#include <cstddef>
#include <regex>

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
  constexpr std::size_t kLongestLooked = 400;  // a regular expression recurses
  if (found.size() > kLongestLooked) return "";
  if (!found.empty() && found.back() == '\r') found.pop_back();
  const std::size_t first = found.find_first_not_of(" \t");
  return first == std::string::npos ? "" : found.substr(first);
}

/// A slip: the form of a line, and its remedy, in which $1 is a part of the line.
struct Slip {
  const char* form;
  const char* remedy;
};

/// Ordered: the first form that is in the line counts.
constexpr Slip kSlips[] = {
    {"\xe2\x80[\x9c\x9d\x9e\x98\x99]", "quotes are plain ones: \" or '"},
    {"^\\[\\[[\\w.-]+\\]?$", "a table of a list ends with two brackets: [[part]]"},
    {"^\\[[\\w.-]+$", "a table's name ends with a bracket: [solver]"},
    {"^([\\w-]+)\\s*:", "write $1 = ..., with = and not :"},
    {"^([\\w-]+)\\s+[\\[\"'0-9-]", "there is no = behind $1"},
    {"=\\s*(-?\\d+),(\\d+)\\s*(#.*)?$", "a decimal point, not a comma: $1.$2"},
    {"=\\s*\\(([^()]*)\\)", "square brackets: [$1]"},
    {"\\[[^\\]]*;", "a comma between numbers, not a semicolon"},
    {"[\\[,=]\\s*(-?\\d+(\\.\\d+)?)\\s*(\xc2\xb0|deg|degrees)",
     "angles are in radians and have no unit: 180 degrees are 3.1416"},
    {"[\\[,=]\\s*(-?\\d+(\\.\\d+)?)\\s*[A-Za-z%]+", "numbers have no unit: $1"},
    {"=\\s*(True|False|TRUE|FALSE|yes|no|on|off|Yes|No|On|Off)\\s*(#.*)?$",
     "say true or false, in small letters"},
    {"[\\[,=]\\s*(-?)(\\.\\d+)", "a digit before the point: $010$2"},
    {"[\\[,=]\\s*(-?\\d+)\\.(?!\\d)", "a digit behind the point: $1.0"},
    {"[\\[,=]\\s*(-?)0+([1-9]\\d*)\\s*([\\],}#]|$)", "no zeros before a number: $1$2"},
    {"\\[\\s*-?\\d+(\\.\\d+)?(,\\d+)?\\s+-?\\d", "a comma between numbers, and a decimal point"},
    {"=\\s*(?!(true|false|inf|nan)\\b)([A-Za-z_][\\w-]*)\\s*(#.*)?$",
     "text stands in quotes: \"$2\""},
    {"=\\s*(\"[^\"]*\"|'[^']*'|[\\w.+-]+|\\[[^\\[\\]]*\\])\\s+[^\\s#]",
     "one value, and nothing behind it on its line"},
    {"=\\s*(#.*)?$", "there is no value behind ="},
};

}  // namespace

std::string TomlHint(const std::string& text, int line) {
  const std::string found = LineOfText(text, line);
  if (found.empty()) return "";
  for (const Slip& slip : kSlips) {
    std::smatch match;
    if (!std::regex_search(found, match, std::regex(slip.form))) continue;
    std::string shown = found.substr(0, found.find(" #"));
    shown.erase(shown.find_last_not_of(" \t") + 1);
    return Printable(shown) + ": " + match.format(slip.remedy);
  }
  return "";
}

}  // namespace seam
