#pragma once
/// The numbers of the balance controllers, by name: character_gains.inc has one a line.

#include <string>
#include <vector>

namespace seam {

/// Built with the values of character_gains.inc.
struct CharacterGains {
#define SEAM_GAIN(name, value) float name = value;
#include "common/stages/character/character_gains.inc"
#undef SEAM_GAIN
};

/// All of them, in the order of the file.
std::vector<std::string> GainNames();
/// The gain of this name, to be read or set; nullptr if there is none.
float* FindGain(CharacterGains* gains, const std::string& name);

}  // namespace seam
