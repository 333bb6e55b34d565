#pragma once
/// The formats of seam-export, one per file; docs/recordings.md describes what each holds.

#include "render/export/output_file.h"
#include "render/export/session.h"

namespace seam {

// Each function writes the selected part of a session, and throws OperatorError when `out` does.

/// csv.cpp: a row for each tick, view and body (RFC 4180, ended by \n).
void WriteCsvExport(const ExportSession& session, OutputFile* out);
/// json.cpp: one document.
void WriteJsonExport(const ExportSession& session, OutputFile* out);
/// mcap.cpp: an MCAP file with Foxglove's messages as JSON.
void WriteMcapExport(const ExportSession& session, OutputFile* out);
/// trace.cpp: the Trace Event Format of Chrome as JSON.
void WriteTraceExport(const ExportSession& session, OutputFile* out);
/// tables.cpp: a row for each event; a row for each peer and second of its counters.
void WriteEventsTable(const ExportSession& session, OutputFile* out);
void WriteMetricsTable(const ExportSession& session, OutputFile* out);

}  // namespace seam
