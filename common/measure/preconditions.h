#pragma once
/// Preconditions of a session's figures: the events that its scene expects must have happened.

#include <string>

#include "common/measure/measure.h"

namespace seam {

/// Returns "" if all preconditions hold, else the first that fails: at least one view was compared,
/// and the events that the scene expects happened (common/scene/expected.h; a contact only if the
/// oracle has looked for one; a hand-over only in modes that have them). The text has no comma and
/// no line end. Throws OperatorError when the recorded scene does not parse.
std::string WhyNotValid(const Recording& recording, const Oracle& oracle, const Measures& measures);

/// Returns the parts of a session that its recording is known to lack, with reasons: "50 messages
/// missing", "12 damaged bytes and 3 undecodable messages"; "" if none. The figures are then those
/// of the rest. The text has no comma and no line end.
std::string LackOf(const Recording& recording);

}  // namespace seam
