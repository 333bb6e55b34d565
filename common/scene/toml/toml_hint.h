#pragma once
/// Plain words for usual slips of a TOML text that its parser describes in words of its own.

#include <optional>
#include <string>

namespace seam {

struct TomlSlip {
  int line = 0;      ///< from 1; of the slip, which may be above the line that was refused
  std::string text;  ///< the slip and its remedy: "torque = 8,0: a decimal point, not a comma: 8.0"
};

/// Returns the slip by which the parser has refused a line (from 1) of the text, if it is known.
/// Call only for lines that were refused.
std::optional<TomlSlip> FindTomlSlip(const std::string& text, int line);

}  // namespace seam
