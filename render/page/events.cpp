#include "render/page/events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/json_text.h"
#include "common/measure/handover_list.h"
#include "common/sync/edits/edit_order.h"
#include "render/page/jumps.h"
#include "render/playback/format.h"
#include "render/playback/marks.h"

namespace seam {
namespace {

std::string BodyName(const Playback& playback, PartId id) {
  const auto& parts = playback.scene().parts;
  const bool known = id >= 0 && static_cast<std::size_t>(id) < parts.size();
  return known ? parts[static_cast<std::size_t>(id)].name : "body " + std::to_string(id);
}

PageEvent Make(std::int64_t tick, const char* kind, int peer, double size, std::string text) {
  PageEvent event;
  event.tick = tick;
  event.kind = kind;
  event.peer = peer;
  event.size = size;
  event.text = std::move(text);
  return event;
}

/// Finds impacts in short windows, since only a few impacts of a window are marked.
std::vector<PageEvent> FindImpacts(const Playback& playback) {
  std::vector<PageEvent> events;
  const Recording& recording = playback.recording();
  const double window = 0.5 * playback.tick_hz();
  for (const int peer : playback.peers()) {
    for (double end = static_cast<double>(recording.first_tick) + window;
         end < static_cast<double>(recording.last_tick) + window; end += window) {
      const std::vector<PageEvent> some = ImpactsBefore(playback, peer, end, window);
      events.insert(events.end(), some.begin(), some.end());
    }
  }
  return events;
}

std::vector<PageEvent> FindHandOvers(const Playback& playback) {
  std::vector<PageEvent> events;
  const RevisionHistory revisions(playback.scene(), playback.recording());
  for (const HandOverSeen& seen : ListHandOvers(playback.recording(), &revisions)) {
    PageEvent event = Make(seen.tick, "hand-over", seen.to, seen.gap_m,
                           fmt::format("{}: {} to {}, {} apart", BodyName(playback, seen.id),
                                       playback.PeerName(seen.from), playback.PeerName(seen.to),
                                       FormatLength(seen.gap_m)));
    event.body = seen.id;
    events.push_back(event);
  }
  return events;
}

std::vector<PageEvent> FindEdits(const Playback& playback) { return EditsAfter(playback, -1); }

/// Finds ticks without a view, peers that begin late or end early, and recorded notes.
std::vector<PageEvent> FindPresence(const Playback& playback) {
  std::vector<PageEvent> events;
  const Recording& recording = playback.recording();
  const std::int64_t near = playback.tick_hz() / 10;  // ticks that count as simultaneous
  for (const auto& [peer, views] : recording.views) {
    if (views.empty()) continue;
    const std::string name = playback.PeerName(peer);
    std::int64_t expected = views.begin()->first;
    if (expected > recording.first_tick + near)
      events.push_back(Make(expected, "join", peer, 0, name + " begins"));
    for (const auto& [tick, view] : views) {
      const std::int64_t missing = tick - expected;
      if (missing > 0)
        events.push_back(Make(expected, "gap", peer, static_cast<double>(missing),
                              fmt::format("{}: {} ticks without a view", name, missing)));
      expected = tick + 1;
    }
    if (expected + near <= recording.last_tick)
      events.push_back(Make(expected, "join", peer, 0, name + " ends"));
  }
  for (const Event& event : recording.events) events.push_back(NoteOf(event));
  return events;
}

/// True if the edit pushes a part that another one has pushed within the last half second.
bool PushesOn(const Playback& playback, std::map<int, EditOrder>::const_iterator place) {
  const auto& edits = playback.recording().edits;
  const EditOrder& order = place->second;
  if (ToEdit(order).As<PushEdit>() == nullptr) return false;
  const std::int64_t since = order.tick - playback.tick_hz() / 2;
  while (place != edits.begin() && (--place)->second.tick >= since) {
    const EditOrder& before = place->second;
    if (before.kind == order.kind && before.a == order.a) return true;
  }
  return false;
}

}  // namespace

std::vector<PageEvent> EventsOf(const Playback& playback) {
  std::vector<PageEvent> all;
  for (const auto find : {FindImpacts, FindHandOvers, FindEdits, FindPresence, FindJumps}) {
    std::vector<PageEvent> events = find(playback);
    std::stable_sort(events.begin(), events.end(),
                     [](const PageEvent& a, const PageEvent& b) { return a.size > b.size; });
    if (events.size() > kPageEventsMax) events.resize(kPageEventsMax);
    all.insert(all.end(), events.begin(), events.end());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const PageEvent& a, const PageEvent& b) { return a.tick < b.tick; });
  return all;
}

PageEvent NoteOf(const Event& event) {
  const bool warns = event.kind == static_cast<std::int8_t>(EventKind::kWarning);
  return Make(event.tick, warns ? "warning" : "note", event.peer, 0, event.text);
}

std::vector<PageEvent> EditsAfter(const Playback& playback, int number) {
  static const char* const kMarkNames[] = {"nothing", "joint broken", "bond", "parts inserted",
                                           "removed", "set free",     "push", "seat taken or left",
                                           "blast"};
  std::vector<PageEvent> events;
  const auto& edits = playback.recording().edits;
  for (auto place = edits.upper_bound(number); place != edits.end(); ++place) {
    const EditOrder& order = place->second;
    const Edit edit = ToEdit(order);
    const std::size_t kind = edit.what.index();
    if (kind == 0 || PushesOn(playback, place)) continue;
    std::string text = kMarkNames[kind];
    if (order.a >= 0) text += ": " + BodyName(playback, order.a);
    events.push_back(Make(order.tick, "edit", -1, 0, text));
    if (const BlastEdit* blast = edit.As<BlastEdit>()) {
      events.back().placed = true;
      events.back().at = blast->centre;
    }
  }
  return events;
}

std::vector<PageEvent> ImpactsBefore(const Playback& playback, int peer, double tick, double span) {
  std::vector<PageEvent> events;
  for (const Mark& mark : MarksBefore(playback.recording(), peer, tick, span)) {
    const auto dv = static_cast<double>(mark.dv);
    PageEvent event =
        Make(std::llround(mark.tick), "impact", peer, dv, fmt::format("impact of {:.1f} m/s", dv));
    event.placed = true;
    event.at = mark.point;
    events.push_back(event);
  }
  return events;
}

PageEvent HandOverEvent(const Playback& playback, std::int64_t tick, int body, int from, int to) {
  PageEvent event = Make(tick, "hand-over", to, 0,
                         fmt::format("{}: {} to {}", BodyName(playback, body),
                                     playback.PeerName(from), playback.PeerName(to)));
  event.body = body;
  return event;
}

std::string EventJson(const PageEvent& event) {
  std::string json = fmt::format(R"({{"tick":{},"kind":{},"peer":{},"size":{},"text":{})",
                                 event.tick, JsonText(event.kind), event.peer,
                                 JsonNumber(event.size, 3), JsonText(event.text));
  if (event.body >= 0) json += fmt::format(R"(,"body":{})", event.body);
  if (event.placed)
    json += fmt::format(R"(,"at":[{},{}])", Thousandths(double{event.at.x()}),
                        Thousandths(double{event.at.y()}));
  return json + "}";
}

}  // namespace seam
