#pragma once
/// Measures of a recording against its oracle (docs/metrics.md).

#include "common/measure/measure.h"
#include "common/measure/preconditions.h"
