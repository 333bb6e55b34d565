#include "render/page/jumps.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "common/measure/parts.h"
#include "common/measure/revisions.h"
#include "render/playback/format.h"

namespace seam {
namespace {

struct Jump {
  std::int64_t tick = 0;
  double size_m = 0;
};

PageEvent EventOf(const Playback& playback, int peer, int body, const Jump& jump) {
  PageEvent event;
  event.tick = jump.tick;
  event.kind = "correction";
  event.peer = peer;
  event.size = jump.size_m;
  event.body = body;
  event.text = fmt::format("{} jumps by {} in {}'s view", playback.PartName(body),
                           FormatLength(jump.size_m), playback.PeerName(peer));
  return event;
}

}  // namespace

std::vector<PageEvent> FindJumps(const Playback& playback) {
  std::vector<PageEvent> events;
  for (const auto& [peer, views] : playback.recording().views) {
    const std::vector<PageEvent> of_peer = FindJumpsOf(playback, peer);
    events.insert(events.end(), of_peer.begin(), of_peer.end());
  }
  return events;
}

std::vector<PageEvent> FindJumpsOf(const Playback& playback, int peer) {
  std::vector<PageEvent> events;
  const auto found_views = playback.recording().views.find(peer);
  if (!playback.has_oracle() || found_views == playback.recording().views.end()) return events;
  const auto& views = found_views->second;
  const Recording& recording = playback.recording();
  const RevisionHistory revisions(playback.scene(), recording);
  const RevisionHistory* changing = revisions.change() ? &revisions : nullptr;
  const double h = TickSeconds(recording);
  const std::int64_t near = std::max(1, playback.tick_hz() / 10);
  std::map<int, Jump> open;  // by body: the largest so far
  for (const auto& [tick, view] : views) {
    const ViewTrio trio = {&view, FindView(views, tick - 1), FindView(views, tick - 2)};
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      const auto squared = StutterSquared(trio, i, playback.oracle(), changing, h);
      const double size_m = squared ? std::sqrt(*squared) * h * h : 0;
      if (size_m < kJump_m) continue;
      const auto [found, fresh] = open.try_emplace(view.id[i], Jump{tick, size_m});
      if (fresh) continue;
      if (tick - found->second.tick > near) {
        events.push_back(EventOf(playback, peer, view.id[i], found->second));
        found->second = {tick, size_m};
      } else if (size_m > found->second.size_m) {
        found->second = {tick, size_m};
      }
    }
  }
  for (const auto& [body, jump] : open) events.push_back(EventOf(playback, peer, body, jump));
  return events;
}

}  // namespace seam
