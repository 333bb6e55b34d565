/// seam-lab check: the words of a script without detours.

#include <algorithm>
#include <cctype>
#include <map>
#include <string>

#include "tests/lab/check/lua_words.h"

namespace seam {
namespace {

bool IsPlainName(const std::string& text) {
  const auto is = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::all_of(text.begin(), text.end(), is);
}

}  // namespace

/// True for "local NAME = VALUE" at `index`, the value a name or text and all of the expression.
bool LuaWords::IsDeclaration(std::size_t index) const {
  const bool local = Is(index, "local") && IsName(index + 1);
  const std::size_t is = index + (Is(index + 2, "<") ? 5 : 2);
  if (!local || !Is(is, "=") || (!IsName(is + 1) && !IsText(is + 1))) return false;
  const LuaWord& next = at(is + 2);
  return (next.kind == LuaWord::Kind::kSymbol && next.text == ";") ||
         next.kind == LuaWord::Kind::kName || next.kind == LuaWord::Kind::kEnd ||
         (next.kind == LuaWord::Kind::kKeyword && next.text != "and" && next.text != "or");
}

/// True if the name that is declared after the "local" at `index` is declared and set only there.
bool LuaWords::IsConstant(std::size_t index) const {
  const std::string& name = at(index + 1).text;
  const auto is = [&](std::size_t i) { return IsName(i) && at(i).text == name && !IsField(i); };
  for (std::size_t i = 0; i < size(); ++i) {
    if (Is(i, "function")) {
      std::size_t k = i + 1;
      while (k < size() && !Is(k, "(")) ++k;
      for (const std::size_t close = CloseOf(k); k < close; ++k) {
        if (is(k)) return false;
      }
    } else if (Is(i, "for") || (Is(i, "local") && i != index)) {
      for (std::size_t k = i + 1; IsName(k) || Is(k, ","); ++k) {
        if (is(k)) return false;
        if (IsName(k) && !Is(k + 1, ",")) break;
      }
    } else if (is(i) && i != index + 1 && (Is(i + 1, "=") || Is(i + 1, ","))) {
      // A name before a comma may be one of several that are assigned; an argument is not.
      std::size_t k = i + 1;
      while (Is(k, ",") && IsName(k + 1)) k += 2;
      if (Is(k, "=")) return false;
    }
  }
  return true;
}

void LuaWords::Resolve() {
  for (std::size_t i = 1; i + 2 < words_.size(); ++i) {
    const bool indexes = IsName(i - 1) || Is(i - 1, ")") || Is(i - 1, "]");
    if (!indexes || !Is(i, "[") || !IsText(i + 1) || !Is(i + 2, "]")) continue;
    if (!IsPlainName(words_[i + 1].text)) continue;
    words_[i].text = ".";
    words_[i + 1].kind = LuaWord::Kind::kName;
    words_.erase(words_.begin() + static_cast<std::ptrdiff_t>(i) + 2);
  }
  std::map<std::string, std::pair<LuaWord, std::size_t>> constants;
  for (std::size_t i = 0; i < size(); ++i) {
    if (!IsDeclaration(i) || !IsConstant(i)) continue;
    const std::size_t is = i + (Is(i + 2, "<") ? 5 : 2);
    constants[at(i + 1).text] = {at(is + 1), is + 1};
  }
  for (std::size_t i = 0; i < size(); ++i) {
    const auto found = constants.find(words_[i].text);
    const bool use = IsName(i) && !IsField(i) && found != constants.end();
    if (!use || i <= found->second.second || Is(i + 1, "=")) continue;
    words_[i].kind = found->second.first.kind;
    words_[i].text = found->second.first.text;
  }
}

}  // namespace seam
