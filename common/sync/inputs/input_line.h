#pragma once
/// An input as a line of text: "DRIVE LIFT BUTTONS", as seam-view --drive prints it and seam-client
/// --inputs reads it.

#include <string>

#include "common/scene/types.h"

namespace seam {

/// Longest line of an input, bytes.
constexpr std::size_t kInputLineBytesMax = 40;

/// Parses a line without its end: drive and lift -127..127, buttons as bits 0..1023. False for any
/// other text; `input` is then unchanged.
bool ParseInputLine(const std::string& line, Input* input);
/// Returns the line, without its end.
std::string InputLine(const Input& input);

}  // namespace seam
