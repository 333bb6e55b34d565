#pragma once
/// Readable numbers: about three digits and a unit.

#include <string>

namespace seam {

/// "0.4 mm", "12 mm", "34 cm", "1.24 m", "17.3 m".
std::string FormatLength(double metres);
/// "3.20 s".
std::string FormatTime(double seconds);
/// Formats a number with `digits` decimals.
std::string FormatNumber(double value, int digits);

}  // namespace seam
