#pragma once
/// What a scene file must be before anything parses it: short, UTF-8, without control characters,
/// and not nested so deeply that a recursive parser runs out of stack.

#include <string>

namespace seam {

/// A scene must fit one message of the bus (60 kB) and one Room.
constexpr std::size_t kSceneBytesMax = 50000;
/// Brackets within brackets; the deepest that the format needs is 5.
constexpr int kSceneNestingMax = 12;
/// Dots in one key.
constexpr int kSceneDotsMax = 4;

/// Throws OperatorError "file:line: what" on the first thing wrong.
void CheckSceneText(const std::string& text, const std::string& file);

/// `text` with everything but printable ASCII replaced by '?', cut at 80 characters: safe to print.
std::string Printable(const std::string& text);

/// True for UTF-8 (RFC 3629: no surrogates, no over-long forms) without control characters other
/// than those in `allowed`.
bool IsCleanText(const std::string& text, const std::string& allowed);

}  // namespace seam
