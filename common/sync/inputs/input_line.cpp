#include "common/sync/inputs/input_line.h"

#include <fmt/format.h>

#include <cstdio>

namespace seam {

bool ParseInputLine(const std::string& line, Input* input) {
  int drive = 0, lift = 0, buttons = 0;
  char rest = 0;
  if (line.size() > kInputLineBytesMax) return false;
  if (std::sscanf(line.c_str(), "%4d %4d %4d %c", &drive, &lift, &buttons, &rest) != 3)
    return false;
  if (drive < -127 || drive > 127 || lift < -127 || lift > 127) return false;
  if (buttons < 0 || buttons > 1023) return false;
  input->drive = static_cast<std::int8_t>(drive);
  input->lift = static_cast<std::int8_t>(lift);
  input->buttons = static_cast<std::int16_t>(buttons);
  return true;
}

std::string InputLine(const Input& input) {
  return fmt::format("{} {} {}", input.drive, input.lift, input.buttons);
}

}  // namespace seam
