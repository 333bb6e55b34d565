#include "render/export/trace_messages.h"

#include <algorithm>

namespace seam {
namespace {

using Views = std::map<std::int64_t, View>;

const Views* ViewsOf(const ExportSession& session, int peer) {
  const auto found = session.recording.views.find(peer);
  return found == session.recording.views.end() ? nullptr : &found->second;
}

/// Returns the server's last view at `us` of its clock or earlier, nullptr if there is none.
const View* ViewAt(const std::vector<const View*>& by_time, std::int64_t us) {
  const auto later = [](std::int64_t t, const View* view) { return t < view->utime; };
  const auto after = std::upper_bound(by_time.begin(), by_time.end(), us, later);
  return after == by_time.begin() ? nullptr : *std::prev(after);
}

void WriteStates(const ExportSession& session, TraceWriter* trace) {
  const Views* server = ViewsOf(session, 0);
  if (server == nullptr) return;
  std::vector<const View*> by_time;
  for (const auto& [tick, view] : *server) by_time.push_back(&view);
  std::stable_sort(by_time.begin(), by_time.end(),
                   [](const View* a, const View* b) { return a->utime < b->utime; });
  for (const States& states : session.recording.states) {
    const Views* sender = states.peer == 0 ? nullptr : ViewsOf(session, states.peer);
    if (sender == nullptr || sender->count(states.tick) == 0) continue;
    const View* accepted = ViewAt(by_time, states.utime);
    if (accepted == nullptr || accepted->tick < states.tick) continue;
    trace->Flow("states", states.peer, states.tick, 0, accepted->tick);
  }
}

void WriteEdits(const ExportSession& session, TraceWriter* trace) {
  const Views* server = ViewsOf(session, 0);
  if (server == nullptr) return;
  for (const auto& [peer, views] : session.recording.views) {
    if (peer == 0) continue;
    auto view = views.begin();
    for (const auto& [number, edit] : session.recording.edits) {
      while (view != views.end() && view->second.revision <= number) ++view;
      if (view == views.end()) break;
      if (view == views.begin()) continue;  // the peer had the edit before its first view
      if (server->count(edit.tick) == 0 || view->first < edit.tick) continue;
      trace->Flow("edit", 0, edit.tick, peer, view->first);
    }
  }
}

}  // namespace

void WriteMessages(const ExportSession& session, TraceWriter* trace) {
  WriteStates(session, trace);
  WriteEdits(session, trace);
}

}  // namespace seam
