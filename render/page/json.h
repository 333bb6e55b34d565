#pragma once
/// The few words of JSON that a page's head is written in.

#include <cstdint>
#include <string>
#include <vector>

namespace seam {

/// A JSON string in plain ASCII: all that is not is escaped, and so are < > & and quotes, so that
/// no text can end the element it stands in. Bytes that are no UTF-8 become U+FFFD.
std::string JsonText(const std::string& text);
/// A number with at most `digits` after the point and no zeros at its end; null unless finite.
std::string JsonNumber(double value, int digits);
/// Whole millimetres (or milliradians) of metres (radians).
std::int64_t Thousandths(double value);
/// "[a,b,c]" of what is JSON already.
std::string JsonList(const std::vector<std::string>& items);

}  // namespace seam
