#include "common/scene/toml/toml_pieces.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace seam {
namespace {

constexpr const char* kSpaces = " \t\r";

bool Opens(char c) { return c == '[' || c == '{'; }
bool Closes(char c) { return c == ']' || c == '}'; }

/// Returns the end of the quoted text that begins at `at`: past its closing quote.
std::size_t EndOfQuoted(const std::string& text, std::size_t at) {
  const char quote = text[at];
  std::size_t end = at + 1;
  for (; end < text.size() && text[end] != quote && text[end] != '\n'; ++end) {
    if (quote == '"' && text[end] == '\\') ++end;
  }
  return std::min(end + 1, text.size());
}

std::string Masked(const std::string& line) {
  std::string masked = line;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '"' && line[i] != '\'') continue;
    const std::size_t end = EndOfQuoted(line, i);
    for (std::size_t k = i + 1; k + 1 < end; ++k) masked[k] = 'q';
    i = end - 1;
  }
  return masked;
}

/// True for [part and [[part.
bool IsHeader(const std::string& line) {
  const std::size_t name = line.find_first_not_of('[');
  return name != std::string::npos && name > 0 && name < 3 &&
         std::isalpha(static_cast<unsigned char>(line[name])) != 0;
}

/// A line being cut; a piece is a range of its characters.
class Cutter {
 public:
  explicit Cutter(const std::string& line) : line_(line), masked_(Masked(line)) {}

  void Cut(std::size_t begin, std::size_t end, TomlPiece::Kind kind) {
    const bool header = kind == TomlPiece::Kind::kLine && IsHeader(line_);
    for (std::size_t i = begin; i < end && !header; ++i) {
      if (!Opens(masked_[i])) continue;
      const std::size_t close = CloseOf(i, end);
      CutAtCommas(i + 1, close,
                  masked_[i] == '{' ? TomlPiece::Kind::kMember : TomlPiece::Kind::kItem);
      i = close;
    }
    while (begin < end && IsSpace(begin)) ++begin;
    while (begin < end && IsSpace(end - 1)) --end;
    if (begin == end) return;
    pieces_.push_back({kind, line_.substr(begin, end - begin), masked_.substr(begin, end - begin)});
  }
  std::vector<TomlPiece> Take() { return std::move(pieces_); }

 private:
  bool IsSpace(std::size_t at) const { return line_[at] == ' ' || line_[at] == '\t'; }

  std::size_t CloseOf(std::size_t open, std::size_t end) const {
    int depth = 0;
    for (std::size_t i = open; i < end; ++i) {
      if (Opens(masked_[i])) ++depth;
      if (Closes(masked_[i]) && --depth == 0) return i;
    }
    return end;
  }
  void CutAtCommas(std::size_t begin, std::size_t end, TomlPiece::Kind kind) {
    int depth = 0;
    for (std::size_t i = begin; i <= end; ++i) {
      if (i < end && Opens(masked_[i])) ++depth;
      if (i < end && Closes(masked_[i])) --depth;
      if (i < end && (masked_[i] != ',' || depth > 0)) continue;
      Cut(begin, i, kind);
      begin = i + 1;
    }
  }

  const std::string& line_;
  const std::string masked_;
  std::vector<TomlPiece> pieces_;
};

}  // namespace

std::string WithoutComment(const std::string& line) {
  std::string text = line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '#') text.erase(i);
    if (i < text.size() && (text[i] == '"' || text[i] == '\'')) i = EndOfQuoted(text, i) - 1;
  }
  text.erase(text.find_last_not_of(kSpaces) + 1);
  return text.erase(0, std::min(text.find_first_not_of(kSpaces), text.size()));
}

std::vector<TomlPiece> PiecesOf(const std::string& line) {
  Cutter cutter(line);
  cutter.Cut(0, line.size(), TomlPiece::Kind::kLine);
  return cutter.Take();
}

std::vector<OpenBracket> OpenBefore(const std::string& text, int line) {
  std::vector<OpenBracket> open;
  int at_line = 1;
  bool line_begins = true, header = false;
  for (std::size_t i = 0; i < text.size() && at_line < line; ++i) {
    const char c = text[i];
    if (c == '\n') {
      ++at_line;
      line_begins = true;
      if (header) open.clear();
      header = false;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (text.compare(i, 3, "'''") == 0) {
      const std::size_t end = std::min(text.find("'''", i + 3), text.size());
      at_line +=
          static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                      text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = end + 2;
    } else if (c == '"' || c == '\'') {
      i = EndOfQuoted(text, i) - 1;
      if (text[i] == '\n') --i;
    } else if (Opens(c)) {
      header = header || (line_begins && open.empty());
      open.push_back({c, at_line});
    } else if (Closes(c) && !open.empty()) {
      open.pop_back();
    }
    if (c != ' ' && c != '\t' && c != '\n') line_begins = false;
  }
  return open;
}

}  // namespace seam
