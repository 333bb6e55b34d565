#pragma once
/// scenes/gas.toml with another number of discs, by the rule stated in that file.

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "common/measure/energy.h"
#include "common/physics/world.h"

namespace seam {

/// Returns the mechanical energy of a room without gravity, J.
inline double KineticEnergy(const World& world) {
  std::vector<BodyState> states;
  for (int b = 0; b < world.body_count(); ++b) states.push_back(world.Read(b));
  return MechanicalEnergy(world.scene(), world.composition(), states);  // without gravity
}

/// Returns the scene's text for `discs` discs, a multiple of 20: the same density and speeds in a
/// longer room. 200 gives the file itself.
inline std::string GasRoomText(int discs) {
  EXPECT_EQ(discs % 20, 0);
  std::ifstream in("scenes/gas.toml");
  std::stringstream read;
  read << in.rdbuf();
  std::string text = read.str();
  const auto replace = [&text](const std::string& from, const std::string& to) {
    std::size_t at = text.find(from), found = 0;
    for (; at != std::string::npos; at = text.find(from, at + to.size()), ++found) {
      text.replace(at, from.size(), to);
    }
    EXPECT_GE(found, 1u) << from;
  };
  const auto number = [](double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.10g", value);
    return std::string(digits);
  };
  const double half = 0.11 * discs;  // of the room's length, m
  for (int column = 0; column < 4; ++column) {
    const double x = 1.1 * column + 0.55;
    replace("[" + number(x - 22) + ", -2.4]", "[" + number(x - half) + ", -2.4]");
  }
  replace("count = [10, 5]", "count = [" + number(discs / 20) + ", 5]");
  replace("[-22.5, 0]", "[" + number(-half - 0.5) + ", 0]");
  replace("step = [45, 0]", "step = [" + number(2 * half + 1) + ", 0]");
  replace("box = [46, 1]", "box = [" + number(2 * half + 2) + ", 1]");
  return text;
}

}  // namespace seam
