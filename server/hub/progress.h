#pragma once
/// What seam-server says of its rooms: a line while they run, lines at the end.

#include <string>

#include "server/hub/hub.h"

namespace seam {

/// Whether a room has started.
bool HubStarted(const Hub& hub);

/// One room: "12 s, tick 750, 2 of 2 player(s), worst round trip 53 ms, loss 1.2 %". Several: "64
/// rooms, 980 player(s), worst p99 tick 2.1 ms, lateness 4.0 ms". And how slow the slowest clock
/// is, if the server does not keep up.
std::string HubProgress(const Hub& hub);

/// Prints what each room did, to stderr; of many rooms the sum. Returns the program's exit status:
/// 1 when a recording failed. To be called after Hub::Close.
int ReportEnd(const Hub& hub);

}  // namespace seam
