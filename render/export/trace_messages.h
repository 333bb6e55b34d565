#pragma once
/// Messages whose both ends a recording knows, as arrows of a trace.

#include "render/export/session.h"
#include "render/export/trace_writer.h"

namespace seam {

/// States of clients, from the tick that they are of to the tick in which the server accepted them
/// (it stamps them, and its views, with one clock); edits, from the tick after which the server
/// ordered them to the first view of each peer that has them. Only between views that were chosen.
/// How the server's states, grants and inputs got to the clients, and what was lost, is in no log.
void WriteMessages(const ExportSession& session, TraceWriter* trace);

}  // namespace seam
