#pragma once
/// Values as JSON (RFC 8259): what any name in a log cannot break.

#include <cstdint>
#include <optional>
#include <string>

namespace seam {

/// In quotes; quotes, backslashes and control characters are escaped, and < so that the text may
/// stand in a page.
std::string JsonText(const std::string& text);
/// Nine digits, which give a float back bit for bit; null for what is not finite.
std::string JsonNumber(double value);
/// null for nothing.
std::string JsonNumber(const std::optional<double>& value);

}  // namespace seam
