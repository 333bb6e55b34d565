#pragma once
/// Progress line and final report of seam-server.

#include <string>

#include "server/hub/hub.h"

namespace seam {

/// True if there is something to report: no worker threads, or a room that has started.
bool HasReport(const Hub& hub);

/// Returns the progress line: for one room as ServerProgress, for several "64 rooms, 980 player(s),
/// worst p99 tick 2.1 ms, lateness 4.0 ms, 2 thread(s)". Adds the speed of the slowest clock if the
/// server is overloaded.
std::string HubProgress(const Hub& hub);

/// Prints the totals of all rooms to stderr, and writes the sums of their sessions to the file
/// `summary` as a JSON array ("": none). Returns the program's exit status: 1 if a recording or
/// that file failed, or a script was stopped. To be called after Hub::Close.
int ReportEnd(const Hub& hub, const std::string& summary);

}  // namespace seam
