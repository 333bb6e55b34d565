#pragma once
/// Messages with a known sender tick and receiver tick, as arrows of a trace.

#include "render/export/session.h"
#include "render/export/trace_writer.h"

namespace seam {

/// Writes arrows between selected views. States of clients: from their own tick to the tick in
/// which the server accepted them (it stamps them, and its views, with one clock). Edits: from the
/// tick after which the server ordered them to each peer's first view with the edit. Logs have no
/// arrival times of the server's messages at clients, and no lost messages.
void WriteMessages(const ExportSession& session, TraceWriter* trace);

}  // namespace seam
