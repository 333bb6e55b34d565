#pragma once
/// What must have happened in a session for its figures to mean what its scene is about.

#include <string>

#include "common/measure/measure.h"

namespace seam {

/// Empty when all holds, else the first that does not: somebody's view was compared, and what the
/// scene expects happened (common/scene/expected.h; a contact as far as the oracle has looked for
/// one; a hand-over only in the modes that have them). No comma, no line end. Throws OperatorError
/// when the recorded scene does not parse.
std::string WhyNotValid(const Recording& recording, const Oracle& oracle, const Measures& measures);

}  // namespace seam
