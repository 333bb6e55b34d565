#pragma once
/// Cuts a line of TOML into the pieces that may hold a slip, and finds brackets left open. For
/// texts that a parser has refused.

#include <string>
#include <vector>

namespace seam {

/// A whole line, a member of an inline table, or an item of an array on the line.
struct TomlPiece {
  enum class Kind { kLine, kMember, kItem };
  Kind kind = Kind::kLine;
  std::string text;
  std::string masked;  ///< the same, with q for each character between quotes
};

/// Returns the pieces of a line, which has no comment: the inner ones first, the line last.
std::vector<TomlPiece> PiecesOf(const std::string& line);
/// Returns the line without spaces around it and without its comment.
std::string WithoutComment(const std::string& line);

struct OpenBracket {
  char bracket = '[';  ///< or {
  int line = 0;        ///< from 1
};
/// Returns the brackets that are open where the line (from 1) of the text begins, outermost first.
std::vector<OpenBracket> OpenBefore(const std::string& text, int line);

}  // namespace seam
