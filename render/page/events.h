#pragma once
/// Events of a recording for navigation: impacts, hand-overs, edits, corrections, gaps in a peer's
/// views, and peers that come and go.

#include <string>
#include <vector>

#include "render/playback/playback.h"

namespace seam {

struct PageEvent {
  std::int64_t tick = 0;
  std::string kind;     ///< impact | hand-over | edit | correction | gap | join | note | warning
  int peer = -1;        ///< the peer concerned; -1: none
  bool placed = false;  ///< true if `at` is set
  Vec2 at{0, 0};        ///< m
  double size = 0;      ///< impact: m/s; hand-over: m between the two views; gap: ticks
  int body = -1;        ///< hand-over, correction: assembly id
  std::string text;     ///< for a person
};

/// Returns the events by tick; of each source at most kPageEventsMax, the largest ones.
std::vector<PageEvent> EventsOf(const Playback& playback);
constexpr std::size_t kPageEventsMax = 500;

/// Returns the mark of an event of the room.
PageEvent NoteOf(const Event& event);
/// Returns the events of the edits with numbers above `number`. Pushes of a part in a row, as of a
/// hand that drags it, are one.
std::vector<PageEvent> EditsAfter(const Playback& playback, int number);
/// Returns the impacts marked in (tick - span, tick] of a peer's view.
std::vector<PageEvent> ImpactsBefore(const Playback& playback, int peer, double tick, double span);
/// Returns a hand-over's event, without the distance of the two views.
PageEvent HandOverEvent(const Playback& playback, std::int64_t tick, int body, int from, int to);

std::string EventJson(const PageEvent& event);

}  // namespace seam
