#pragma once
/// Values as JSON (RFC 8259) that no name in a log can break.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seam {

/// Returns `text` as a JSON string in plain ASCII. Everything else is escaped, also < > & and
/// quotes, so that no text can close the HTML element around it. Invalid UTF-8 becomes U+FFFD.
std::string JsonText(const std::string& text);
/// Returns a number with at most `digits` after the point and no trailing zeros; null unless
/// finite.
std::string JsonNumber(double value, int digits);
/// Returns a number with nine digits, enough to restore a float bit for bit; null unless finite.
std::string JsonNumber(double value);
/// As above; null for nullopt.
std::string JsonNumber(const std::optional<double>& value);
/// Rounds metres (radians) to whole millimetres (milliradians); 0 unless finite.
std::int64_t Thousandths(double value);
/// Returns "[a,b,c]". The items must be JSON already.
std::string JsonList(const std::vector<std::string>& items);

}  // namespace seam
