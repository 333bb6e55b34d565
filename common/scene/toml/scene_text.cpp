#include "common/scene/toml/scene_text.h"

#include <algorithm>
#include <cstdint>

#include "common/base/check.h"

namespace seam {
namespace {

/// Returns the code point at `at` and advances `at` past it; -1 if the bytes are not UTF-8.
std::int32_t NextCodePoint(const std::string& text, std::size_t* at) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::int32_t>(static_cast<unsigned char>(text[i]));
  };
  const std::int32_t lead = byte(*at);
  ++*at;
  if (lead < 0x80) return lead;
  const int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
  if (lead < 0xc2 || lead > 0xf4) return -1;
  std::int32_t point = lead & (0x3f >> more);
  for (int i = 0; i < more; ++i, ++*at) {
    if (*at >= text.size() || (byte(*at) & 0xc0) != 0x80) return -1;
    point = (point << 6) | (byte(*at) & 0x3f);
  }
  constexpr std::int32_t kSmallest[] = {0x80, 0x800, 0x10000};
  const bool surrogate = point >= 0xd800 && point <= 0xdfff;
  return point < kSmallest[more - 1] || surrogate || point > 0x10ffff ? -1 : point;
}

bool IsControl(std::int32_t point) { return point < 0x20 || (point >= 0x7f && point < 0xa0); }

[[noreturn]] void Fail(const std::string& file, int line, const std::string& what) {
  throw OperatorError(file + ":" + std::to_string(line) + ": " + what);
}

void CheckCharacters(const std::string& text, const std::string& file) {
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    const std::int32_t point = NextCodePoint(text, &at);
    if (point < 0) Fail(file, line, "not UTF-8");
    const bool line_end = c == '\n' || (c == '\r' && at < text.size() && text[at] == '\n');
    if (c == '\n') ++line;
    if (IsControl(point) && c != '\t' && !line_end) Fail(file, line, "a control character");
  }
}

/// Returns the end of the multi-line code at `at`; moves `line` to it. Only scripts may be
/// multi-line, and only between ''': such text is literal, so that its lines are the file's.
std::size_t EndOfCode(const std::string& text, std::size_t at, const std::string& file, int* line) {
  const std::size_t begin = text.rfind('\n', at) + 1;  // npos + 1 is 0
  std::string before = text.substr(begin, at - begin);
  before.erase(
      std::remove_if(before.begin(), before.end(), [](char c) { return c == ' ' || c == '\t'; }),
      before.end());
  if (before != "script=" && before != "code=") {
    Fail(file, *line, "multi-line text is not allowed");
  }
  if (text[at] != '\'') Fail(file, *line, "code stands between ''' and ''', not \"\"\"");
  const std::size_t end = text.find("'''", at + 3);
  if (end == std::string::npos) Fail(file, *line, "code without its closing '''");
  *line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                       text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
  if (end + 3 < text.size() && text[end + 3] == '\'') Fail(file, *line, "one quote too many");
  return end + 2;
}

/// Reads just enough TOML to tell brackets from text and comments.
void CheckNesting(const std::string& text, const std::string& file) {
  int line = 1, depth = 0, dots = 0;
  char quote = 0;
  bool comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      if (quote != 0) Fail(file, line, "text without its closing quote");
      ++line;
      dots = 0;
      comment = false;
    } else if (comment) {
      continue;
    } else if (quote != 0) {
      if (c == '\\' && quote == '"') ++i;
      if (c == quote) quote = 0;
      if (i < text.size() && text[i] == '\n') --i;
    } else if (c == '"' || c == '\'') {
      if (text.compare(i, 3, std::string(3, c)) == 0) {
        i = EndOfCode(text, i, file, &line);
      } else {
        quote = c;
      }
    } else if (c == '#') {
      comment = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kSceneNestingMax) Fail(file, line, "nested too deeply");
      dots = 0;
    } else if (c == ']' || c == '}') {
      if (depth > 0) --depth;
      dots = 0;
    } else if (c == ',' || c == '=') {
      dots = 0;
    } else if (c == '.' && ++dots > kSceneDotsMax) {
      Fail(file, line, "too many dots in a key");
    }
  }
}

}  // namespace

void CheckSceneText(const std::string& text, const std::string& file) {
  if (text.size() > kSceneBytesMax) {
    Fail(
        file, 1,
        "a scene may have at most " + std::to_string(kSceneBytesMax) + " bytes; this one has more");
  }
  CheckCharacters(text, file);
  CheckNesting(text, file);
}

std::string Printable(const std::string& text) {
  std::string out;
  for (const char c : text.substr(0, 80)) out += c >= ' ' && c <= '~' ? c : '?';
  return out;
}

bool IsCleanText(const std::string& text, const std::string& allowed) {
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    const std::int32_t point = NextCodePoint(text, &at);
    if (point < 0) return false;
    if (IsControl(point) && allowed.find(c) == std::string::npos) return false;
  }
  return true;
}

}  // namespace seam
