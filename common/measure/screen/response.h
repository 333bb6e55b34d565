#pragma once
/// Response time: from an input to the motion that it causes on each screen, by the clock.

#include "common/measure/measure.h"

namespace seam {

/// Sets response_own_ms, response_server_ms and response_other_ms. Simulates two seconds for each
/// examined input change, so it is not part of Measure. Throws OperatorError when the recorded
/// scene does not parse. Sets nothing for a recording without a scene or without
/// Recording::view_us.
void MeasureResponse(const Recording& recording, const Oracle& oracle, Measures* measures);

}  // namespace seam
