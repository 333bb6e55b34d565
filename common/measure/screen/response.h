#pragma once
/// From an input to what it moves on each screen, by the clock.

#include "common/measure/measure.h"

namespace seam {

/// response_own_ms, response_server_ms, response_other_ms. Simulates two seconds for each input
/// change that it looks at, so it is not part of Measure. `input_delay_ticks`: by how many ticks
/// inputs act later than they are read. Throws OperatorError when the recorded scene does not
/// parse; nothing is measured in a recording without a scene or without Recording::view_us.
void MeasureResponse(const Recording& recording, const Oracle& oracle, int input_delay_ticks,
                     Measures* measures);

}  // namespace seam
