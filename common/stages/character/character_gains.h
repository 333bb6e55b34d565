#pragma once
/// Gains of the balance controllers, by name: character_gains.inc has one a line.

#include <string>
#include <vector>

namespace seam {

/// Initialised from character_gains.inc.
struct CharacterGains {
#define SEAM_GAIN(name, value) float name = value;
#include "common/stages/character/character_gains.inc"
#undef SEAM_GAIN
};

/// Returns all names, in the order of the file.
std::vector<std::string> GainNames();
/// Returns the gain of this name, for reading or writing; nullptr if there is none.
float* FindGain(CharacterGains* gains, const std::string& name);

}  // namespace seam
