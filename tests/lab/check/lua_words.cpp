#include "tests/lab/check/lua_words.h"

#include <algorithm>
#include <cctype>

namespace seam {
namespace {

constexpr const char* kKeywords[] = {"and",   "break", "do",       "else", "elseif", "end",
                                     "false", "for",   "function", "goto", "if",     "in",
                                     "local", "nil",   "not",      "or",   "repeat", "return",
                                     "then",  "true",  "until",    "while"};
/// Longer ones first.
constexpr const char* kSymbols[] = {"...", "..", "==", "~=", "<=", ">=", "//", "::", "<<", ">>"};

/// Returns the number of '=' of a long bracket at `at`, "[==["; -1: there is none.
int LongBracket(const std::string& code, std::size_t at) {
  if (at >= code.size() || code[at] != '[') return -1;
  std::size_t i = at + 1;
  while (i < code.size() && code[i] == '=') ++i;
  return i < code.size() && code[i] == '[' ? static_cast<int>(i - at - 1) : -1;
}

bool IsWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

}  // namespace

LuaWords::LuaWords(const std::string& code, int line) { Read(code, line); }

void LuaWords::Read(const std::string& code, int line) {
  std::size_t i = 0;
  const auto long_text = [&](std::size_t at, int level) {
    const std::string close = "]" + std::string(static_cast<std::size_t>(level), '=') + "]";
    const std::size_t begin = at + close.size();
    const std::size_t end = std::min(code.find(close, begin), code.size());
    line += static_cast<int>(std::count(code.begin() + static_cast<std::ptrdiff_t>(at),
                                        code.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    i = std::min(end + close.size(), code.size());
    return code.substr(begin, end - std::min(begin, end));
  };
  while (i < code.size()) {
    const char c = code[i];
    if (c == '\n') ++line;
    if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      ++i;
      continue;
    }
    if (code.compare(i, 2, "--") == 0) {
      const int level = LongBracket(code, i + 2);
      if (level >= 0) {
        long_text(i + 2, level);
      } else {
        i = std::min(code.find('\n', i), code.size());
      }
      continue;
    }
    LuaWord word;
    word.line = line;
    std::size_t end = i + 1;
    if (c == '"' || c == '\'') {
      while (end < code.size() && code[end] != c) end += code[end] == '\\' ? 2 : 1;
      word.kind = LuaWord::Kind::kText;
      word.text = code.substr(i + 1, std::min(end, code.size()) - i - 1);
      ++end;
    } else if (LongBracket(code, i) >= 0) {
      word.kind = LuaWord::Kind::kText;
      word.text = long_text(i, LongBracket(code, i));
      words_.push_back(word);
      continue;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      while (end < code.size() && (IsWord(code[end]) || code[end] == '.')) ++end;
      if (code.compare(end - 1, 2, "..") == 0) --end;  // of a range of texts
      word.kind = LuaWord::Kind::kNumber;
      word.text = code.substr(i, end - i);
    } else if (IsWord(c)) {
      while (end < code.size() && IsWord(code[end])) ++end;
      word.text = code.substr(i, end - i);
      const bool keyword =
          std::find(std::begin(kKeywords), std::end(kKeywords), word.text) != std::end(kKeywords);
      word.kind = keyword ? LuaWord::Kind::kKeyword : LuaWord::Kind::kName;
    } else {
      word.kind = LuaWord::Kind::kSymbol;
      word.text = std::string(1, c);
      for (const char* symbol : kSymbols) {
        const std::string text = symbol;
        if (code.compare(i, text.size(), text) != 0) continue;
        word.text = text;
        end = i + text.size();
        break;
      }
    }
    i = std::min(end, code.size());
    words_.push_back(word);
  }
}

const LuaWord& LuaWords::at(std::size_t index) const {
  return index < words_.size() ? words_[index] : none_;
}

bool LuaWords::Is(std::size_t index, const char* symbol_or_keyword) const {
  const LuaWord& word = at(index);
  const bool fixed = word.kind == LuaWord::Kind::kSymbol || word.kind == LuaWord::Kind::kKeyword;
  return fixed && word.text == symbol_or_keyword;
}

std::size_t LuaWords::CloseOf(std::size_t open) const {
  int depth = 0;
  for (std::size_t i = open; i < size(); ++i) {
    if (Is(i, "(") || Is(i, "{") || Is(i, "[")) ++depth;
    if (Is(i, ")") || Is(i, "}") || Is(i, "]")) --depth;
    if (depth == 0) return i;
  }
  return size();
}

std::size_t LuaWords::EndOf(std::size_t begin) const {
  int depth = 0;
  for (std::size_t i = begin; i < size(); ++i) {
    // A while or for has one `do`, an if one `if`.
    if (Is(i, "function") || Is(i, "do") || Is(i, "if") || Is(i, "repeat")) ++depth;
    if (Is(i, "end") || Is(i, "until")) --depth;
    if (depth == 0) return i;
  }
  return size();
}

}  // namespace seam
