#pragma once
/// What seam-server says of its rooms: a line while they run, lines at the end.

#include <string>

#include "server/hub/hub.h"

namespace seam {

/// Whether there is anything to tell of it: one room, or one of several that has started.
bool HubTells(const Hub& hub);

/// One room: see ServerProgress. Several: "64
/// rooms, 980 player(s), worst p99 tick 2.1 ms, lateness 4.0 ms". And how slow the slowest clock
/// is, if the server does not keep up.
std::string HubProgress(const Hub& hub);

/// Prints what each room did, to stderr; of many rooms the sum. Returns the program's exit status:
/// 1 when a recording failed. To be called after Hub::Close.
int ReportEnd(const Hub& hub);

}  // namespace seam
