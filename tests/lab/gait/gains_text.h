#pragma once
/// The text of the gains file that the build takes.

#include <string>

#include "common/stages/character/character_gains.h"

namespace seam {

/// `before` with the values of `gains` in its lines SEAM_GAIN(name, value), everything else as it
/// was. Throws OperatorError if a gain has no line there.
std::string WithGains(const std::string& before, const CharacterGains& gains);

}  // namespace seam
