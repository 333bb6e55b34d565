/// The Trace Event Format that ui.perfetto.dev and chrome://tracing open: peers as processes.
/// Times are those of the session: tick n begins n ticks after tick 0.

#include <algorithm>

#include "common/measure/mean_square.h"
#include "common/measure/parts.h"
#include "render/export/formats.h"
#include "common/base/json_text.h"
#include "render/export/trace_messages.h"
#include "render/export/trace_writer.h"

namespace seam {
namespace {

void WriteNames(const ExportSession& session, TraceWriter* trace) {
  for (const auto& [peer, views] : session.recording.views) {
    trace->Name(peer, session.ViewName(peer));
  }
}

/// Returns when the bus received the view, if known; its clock differs from the session's.
std::string HeardAt(const ExportSession& session, const View& view) {
  const auto of_peer = session.recording.view_us.find(view.peer);
  if (of_peer == session.recording.view_us.end()) return "";
  const auto heard = of_peer->second.find(view.tick);
  if (heard == of_peer->second.end()) return "";
  return ",\"heard_us\":" + std::to_string(heard->second);
}

void WriteTicks(const ExportSession& session, TraceWriter* trace) {
  ForEachView(session, [&](const View& view) {
    trace->Slice(view.peer, view.tick, "tick " + std::to_string(view.tick),
                 "\"tick\":" + std::to_string(view.tick) +
                     ",\"revision\":" + std::to_string(view.revision) + HeardAt(session, view));
  });
}

/// Writes the spans in which a peer has authority over a body, by its own view.
void WriteAuthority(const ExportSession& session, TraceWriter* trace) {
  for (const auto& [peer, views] : session.recording.views) {
    std::map<PartId, std::int64_t> since;
    std::int64_t last = 0;
    const auto end = [&](PartId id, std::int64_t tick) {
      trace->Span(peer, since[id], tick, id, session.of.at(id));
      since.erase(id);
    };
    for (const auto& [tick, view] : views) {
      std::set<PartId> held;
      for (const ExportRow& row : RowsOf(session, view)) {
        if (view.authority[row.i] == peer) held.insert(row.id);
      }
      const auto before = since;
      for (const auto& [id, from] : before) {
        if (held.count(id) == 0) end(id, tick);
      }
      for (const PartId id : held) since.emplace(id, tick);
      last = tick;
    }
    const auto open = since;
    for (const auto& [id, from] : open) end(id, last + 1);
  }
}

void WriteCounters(const ExportSession& session, TraceWriter* trace) {
  if (!session.oracle) return;
  const RevisionHistory* changing = session.revisions->change() ? session.revisions.get() : nullptr;
  ForEachView(session, [&](const View& view) {
    const auto& views = session.recording.views.at(view.peer);
    const ViewTrio trio = {&view, FindView(views, view.tick - 1), FindView(views, view.tick - 2)};
    MeanSquare error, stutter;
    for (const ExportRow& row : RowsOf(session, view)) {
      if (row.error_m) error.Add(*row.error_m * *row.error_m);
      const auto squared =
          StutterSquared(trio, row.i, *session.oracle, changing, session.TickSeconds());
      if (squared) stutter.Add(*squared);
    }
    if (error.count > 0) trace->Counter(view.peer, view.tick, "error_m", error.RootOrZero());
    if (stutter.count > 0) {
      trace->Counter(view.peer, view.tick, "stutter_mps2", stutter.RootOrZero());
    }
  });
}

void WriteEvents(const ExportSession& session, TraceWriter* trace) {
  for (const Event& event : session.recording.events) {
    trace->Instant(event.peer, event.tick, event.text);
  }
}

}  // namespace

void WriteTraceExport(const ExportSession& session, OutputFile* out) {
  TraceWriter trace(out, session.recording.room.tick_hz);
  WriteNames(session, &trace);
  WriteTicks(session, &trace);
  WriteAuthority(session, &trace);
  WriteCounters(session, &trace);
  WriteEvents(session, &trace);
  WriteMessages(session, &trace);
  trace.Finish();
}

}  // namespace seam
