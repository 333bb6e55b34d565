#pragma once
/// Numbers as a reader wants them: three digits and a unit.

#include <string>

namespace seam {

/// "0.4 mm", "12 mm", "34 cm", "1.24 m", "17.3 m".
std::string FormatLength(double metres);
/// "3.20 s".
std::string FormatTime(double seconds);
/// With `digits` behind the point.
std::string FormatNumber(double value, int digits);

}  // namespace seam
