#pragma once
/// Values as JSON (RFC 8259): what any name in a log cannot break.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seam {

/// A JSON string in plain ASCII: all that is not is escaped, and so are < > & and quotes, so that
/// no text can end the element it stands in. Bytes that are no UTF-8 become U+FFFD.
std::string JsonText(const std::string& text);
/// A number with at most `digits` after the point and no zeros at its end; null unless finite.
std::string JsonNumber(double value, int digits);
/// Nine digits, which give a float back bit for bit; null for what is not finite.
std::string JsonNumber(double value);
/// null for nothing.
std::string JsonNumber(const std::optional<double>& value);
/// Whole millimetres (or milliradians) of metres (radians).
std::int64_t Thousandths(double value);
/// "[a,b,c]" of what is JSON already.
std::string JsonList(const std::vector<std::string>& items);

}  // namespace seam
