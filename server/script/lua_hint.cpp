#include "server/script/lua_hint.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "common/scene/toml/line_form.h"

namespace seam {
namespace {

constexpr std::size_t kLuaLongestLooked = 400;  ///< bytes; no people write longer lines

/// Returns a line without its comment, and with q for what is quoted; "" if it is too long.
std::string Masked(std::string line) {
  if (line.size() > kLuaLongestLooked) return "";
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote == 0 && line.compare(i, 2, "--") == 0) return line.substr(0, i);
    if (quote == 0) {
      if (c == '"' || c == '\'') quote = c;
    } else if (c == quote) {
      quote = 0;
    } else {
      if (c == '\\' && i + 1 < line.size()) line[i++] = 'q';
      line[i] = 'q';
    }
  }
  return line;
}

/// A slip: words of Lua's message, the form of the line, and the cure, with $1 from the line.
struct Slip {
  const char* message;
  const char* form;
  const char* cure;
};

constexpr Slip kLuaSlips[] = {
    {"near '!'", "!=", "not equal is ~= in Lua"},
    {"near '!'", "!", "not is a word in Lua"},
    {"near '&'", "&&", "and is a word in Lua"},
    {"near '|'", "[|][|]", "or is a word in Lua"},
    {"near '='", "\\b(if|elseif|while|until)\\b.*[^=~<>]=[^=]", "equal is == in a condition"},
    {"near '", "([][[:alnum:]_.]+)\\s*([-+*/%])=", "Lua has no $2=: write $1 = $1 $2 ..."},
    {"near '", "([][[:alnum:]_.]+)\\s*[.][.]=", "Lua has no ..=: write $1 = $1 .. ..."},
    {"near '+'", "([][[:alnum:]_.]+)\\s*[+][+]", "Lua has no ++: write $1 = $1 + 1"},
    {"arithmetic on a string", "[+]", "texts are joined by .."},
};

}  // namespace

std::string LuaHint(const ScriptSource& source, const std::string& error) {
  const std::size_t colon = error.find(':');
  if (colon == std::string::npos) return "";
  const int at = std::atoi(error.c_str() + colon + 1);
  const bool unended = error.find("'end' expected") != std::string::npos;
  int line = source.line;
  for (std::size_t begin = 0; begin < source.code.size() && line <= at; ++line) {
    const std::size_t end = std::min(source.code.find('\n', begin), source.code.size());
    const std::string text = Masked(source.code.substr(begin, end - begin));
    begin = end + 1;
    if (unended && FindForm("\\belse\\s+if\\b", text, text)) {
      return " (line " + std::to_string(line) +
             ": \"else if\" begins another if with an end of its own, elseif does not)";
    }
    if (line < at) continue;
    for (const Slip& slip : kLuaSlips) {
      if (error.find(slip.message) == std::string::npos) continue;
      const std::optional<FormMatch> match = FindForm(slip.form, text, text);
      if (match) return " (" + Filled(slip.cure, *match) + ")";
    }
  }
  return "";
}

}  // namespace seam
