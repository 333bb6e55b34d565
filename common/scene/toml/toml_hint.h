#pragma once
/// Plain words for usual slips of a TOML text that its parser describes in words of its own.

#include <string>

namespace seam {

/// Returns the slip on a line (from 1) of the text, and its remedy: "torque = 8,0: a decimal point,
/// not a comma: 8.0". "" if none is recognised. Call only for lines that the parser has refused.
std::string TomlHint(const std::string& text, int line);

}  // namespace seam
