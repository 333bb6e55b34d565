#include "common/scene/toml/toml_hint.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/toml/line_form.h"
#include "common/scene/toml/scene_text.h"
#include "common/scene/toml/toml_pieces.h"

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

/// The pieces of a line in which a slip may be.
enum class In { kLine, kMember, kItem, kBoth };

bool MayBeIn(In in, TomlPiece::Kind kind) {
  switch (kind) {
    case TomlPiece::Kind::kLine: return in == In::kLine || in == In::kBoth;
    case TomlPiece::Kind::kMember: return in == In::kMember || in == In::kBoth;
    case TomlPiece::Kind::kItem: return in == In::kItem;
  }
  return false;
}

/// A slip: its place, its form, a POSIX extended regular expression with GNU's \w, \s and \b, and
/// its remedy, in which $1 is a part of the piece.
struct Slip {
  In in;
  const char* form;
  const char* remedy;
  const char* unless = nullptr;  ///< a form that is no such slip
};

#define SEAM_VALUE "(\"[^\"]*\"|'[^']*'|[[:alnum:]_.+-]+|\\[[^][]*\\])"

/// Ordered: the first form that is in the piece counts.
constexpr Slip kSlips[] = {
    {In::kBoth, "\xe2\x80(\x9c|\x9d|\x9e|\x98|\x99)", "quotes are plain ones: \" or '"},
    {In::kLine, "\xe2\x88\x92|\xe2\x80(\x93|\x94)", "a minus is the plain one: -"},
    {In::kLine, "^\\[\\[[[:alnum:]_.-]+\\]?$",
     "a table of a list ends with two brackets: [[part]]"},
    {In::kLine, "^\\[[[:alnum:]_.-]+$", "a table's name ends with a bracket: [solver]"},
    {In::kBoth, "^([[:alnum:]_-]+)\\s*:", "write $1 = ..., with = and not :"},
    {In::kBoth, "^([[:alnum:]_-]+)\\s+[[\"'0-9-]", "there is no = behind $1"},
    {In::kMember, "=\\s*" SEAM_VALUE "\\s+([[:alnum:]_-]+)\\s*=", "a comma goes before $2"},
    {In::kLine, "=\\s*" SEAM_VALUE "\\s+([[:alnum:]_-]+)\\s*=", "$2 goes on a line of its own"},
    {In::kLine, "=\\s*(-?[0-9]+),([0-9]+)$", "a decimal point, not a comma: $1.$2"},
    {In::kMember, "^[0-9]+$", "a decimal point, not a comma"},
    {In::kBoth, "=\\s*\\(([^()]*)\\)", "square brackets: [$1]"},
    {In::kBoth, "\\[[^]]*;", "a comma between numbers, not a semicolon"},
    {In::kLine, ";$", "no semicolon at a line's end"},
    {In::kMember, ";", "a comma between members, not a semicolon"},
    {In::kBoth, "[[,=]\\s*(-?[0-9]+(\\.[0-9]+)?)\\s*(\xc2\xb0|deg|degrees)",
     "angles are in radians and have no unit: 180 degrees are 3.1416"},
    {In::kBoth, "[[,=]\\s*(-?[0-9]+(\\.[0-9]+)?)\\s*[A-Za-z%]+", "numbers have no unit: $1"},
    {In::kBoth, "=\\s*(True|False|TRUE|FALSE|yes|no|on|off|Yes|No|On|Off)$",
     "say true or false, in small letters"},
    {In::kBoth, "[[,=]\\s*(-?)(\\.[0-9]+)", "a digit before the point: $10$2"},
    {In::kBoth, "[[,=]\\s*(-?[0-9]+)\\.([^0-9]|$)", "a digit behind the point: $1.0"},
    {In::kBoth, "[[,=]\\s*(-?)0+([1-9][0-9]*)\\s*([],}#]|$)", "no zeros before a number: $1$2"},
    {In::kBoth, "\\[\\s*-?[0-9]+(\\.[0-9]+)?(,[0-9]+)?\\s+-?[0-9]",
     "a comma between numbers, and a decimal point"},
    {In::kBoth, "=\\s*([A-Za-z_][[:alnum:]_-]*)$", "text stands in quotes: \"$1\"",
     "=\\s*(true|false|inf|nan)\\b"},
    {In::kItem, "^([A-Za-z_][[:alnum:]_-]*)$", "text stands in quotes: \"$1\"",
     "^(true|false|inf|nan)$"},
    {In::kBoth, "=\\s*" SEAM_VALUE "\\s+[^[:space:]#]",
     "one value, and nothing behind it on its line"},
    {In::kBoth, "=$", "there is no value behind ="},
};

#undef SEAM_VALUE

std::optional<FormMatch> Find(const char* form, const TomlPiece& piece) {
  return FindForm(form, piece.masked, piece.text);
}

std::string Told(const TomlPiece& piece, const std::string& remedy) {
  return Printable(piece.text) + ": " + remedy;
}

/// A header such as [part] where the text has [[part]], or has it twice.
std::optional<TomlSlip> OfHeader(const std::string& text, int line, const TomlPiece& whole) {
  const std::optional<FormMatch> header = Find("^\\[([[:alnum:]_.-]+)\\]$", whole);
  if (!header) return std::nullopt;
  const std::string& name = header->parts[1];
  const std::string list = "[[" + name + "]]";
  if (text.find("\n" + list) != std::string::npos || text.rfind(list, 0) == 0) {
    return TomlSlip{line, Told(whole, "needs two brackets, " + list + ": there may be several")};
  }
  const std::string again = "\n" + whole.text;
  const std::size_t above = ("\n" + text).find(again);
  if (above == std::string::npos) return std::nullopt;
  const auto breaks =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(above), '\n');
  if (breaks + 1 < line) {
    return TomlSlip{line, Told(whole, "there is another on line " + std::to_string(breaks + 1))};
  }
  return std::nullopt;
}

/// A bracket that is open where a key or a table begins, or a table over several lines.
std::optional<TomlSlip> OfBracket(const std::string& text, int line, const TomlPiece& whole) {
  const std::vector<OpenBracket> before = OpenBefore(text, line);
  const bool begins = Find("^[[:alnum:]_-]+\\s*=|^\\[\\[?[A-Za-z]", whole).has_value();
  if (!before.empty() && begins) {
    const OpenBracket& open = before.back();
    const TomlPiece opening{TomlPiece::Kind::kLine, WithoutComment(LineOfText(text, open.line)),
                            ""};
    return TomlSlip{open.line, open.bracket == '['
                                   ? Told(opening, "its [ is not closed")
                                   : Told(opening, "a table in { } stands on one line")};
  }
  const std::vector<OpenBracket> after = OpenBefore(text, line + 1);
  if (after.size() <= before.size() || after.back().bracket != '{') return std::nullopt;
  return TomlSlip{line, Told(whole, "a table in { } stands on one line")};
}

}  // namespace

std::optional<TomlSlip> FindTomlSlip(const std::string& text, int line) {
  const std::vector<TomlPiece> pieces = PiecesOf(WithoutComment(LineOfText(text, line)));
  if (pieces.empty()) return std::nullopt;
  if (const auto slip = OfHeader(text, line, pieces.back())) return slip;
  if (const auto slip = OfBracket(text, line, pieces.back())) return slip;
  for (const TomlPiece& piece : pieces) {
    for (const Slip& slip : kSlips) {
      if (!MayBeIn(slip.in, piece.kind)) continue;
      const std::optional<FormMatch> match = Find(slip.form, piece);
      if (!match || (slip.unless != nullptr && Find(slip.unless, piece))) continue;
      return TomlSlip{line, Told(pieces.back(), Filled(slip.remedy, *match))};
    }
  }
  return std::nullopt;
}

}  // namespace seam
