#pragma once
/// Events as text, for programs that list them.

#include <cstdint>
#include <string>

#include "common/codec/event.h"

namespace seam {

/// Returns "joined", "broke", ... (lcmtypes/event_t.lcm).
const char* EventKindName(std::int8_t kind);
/// Returns "trusted", "noted", ... of a step of trust in a client (lcmtypes/audit_t.lcm).
const char* TrustStepName(std::int8_t step);
/// Returns a JSON object on one line, without what is -1. `time_s`: of the session.
std::string EventJson(const Event& event, double time_s);

}  // namespace seam
