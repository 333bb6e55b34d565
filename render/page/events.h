#pragma once
/// The moments of a recording that a reviewer jumps to: impacts, hand-overs, edits, gaps in what a
/// peer showed, and peers that come and go.

#include <string>
#include <vector>

#include "render/playback/playback.h"

namespace seam {

struct PageEvent {
  std::int64_t tick = 0;
  std::string kind;     ///< impact | hand-over | edit | gap | join | note
  int peer = -1;        ///< whose; -1: nobody's
  bool placed = false;  ///< `at` says where
  Vec2 at{0, 0};        ///< m
  double size = 0;      ///< impact: m/s; hand-over: m between the two views; gap: ticks
  int body = -1;        ///< hand-over: assembly id
  std::string text;     ///< for a person
};

/// In the order of ticks; at most kPageEventsMax of each kind, the largest ones.
std::vector<PageEvent> EventsOf(const Playback& playback);
constexpr std::size_t kPageEventsMax = 500;

std::string EventJson(const PageEvent& event);

}  // namespace seam
