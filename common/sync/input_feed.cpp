#include "common/sync/input_feed.h"

#include <algorithm>

namespace seam {

std::optional<Inputs> InputFeed::Take(const InputTrack& track, int player, std::int64_t acked,
                                      std::int64_t now, bool rides) {
  const std::int64_t newest = track.newest();
  const bool fresh = newest > sent_newest_;
  if (newest <= acked || (!fresh && now <= sent_at_)) return std::nullopt;
  const std::int64_t first = std::max(acked + 1, newest + 1 - kInputsRedundant);
  if (!track.Surprises(first) && !(rides && fresh)) return std::nullopt;
  sent_newest_ = newest;
  sent_at_ = now;
  const int count = static_cast<int>(newest + 1 - first);
  return track.Export(player, std::max(count, kInputsAtLeast));
}

}  // namespace seam
