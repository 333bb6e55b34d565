#include "common/sync/inputs/input_feed.h"

#include <algorithm>

namespace seam {

int InputFeed::Take(const InputTrack& track, std::int64_t acked, std::int64_t now,
                    std::int64_t now_us, bool rides) {
  const std::int64_t newest = track.newest();
  const bool fresh = newest > sent_newest_;
  const bool again = now > sent_at_ || now_us - sent_us_ >= kInputRepeatUs;
  if (newest <= acked || !(fresh || again)) return 0;
  const std::int64_t first = std::max(acked + 1, newest + 1 - kInputsRedundant);
  if (!(rides && fresh) && !track.DiffersFromPrediction(first)) return 0;
  sent_newest_ = newest;
  sent_at_ = now;
  sent_us_ = now_us;
  return std::max(static_cast<int>(newest + 1 - first), kInputsAtLeast);
}

int InputFeed::TakeAll(const InputTrack& track, std::int64_t acked, std::int64_t now_us) {
  const std::int64_t newest = track.newest();
  const bool due = newest > sent_newest_ || now_us - sent_us_ >= kInputRepeatUs;
  if (newest <= acked || !due) return 0;
  sent_newest_ = newest;
  sent_us_ = now_us;
  return static_cast<int>(std::min(newest - acked, static_cast<std::int64_t>(kInputsMax)));
}

}  // namespace seam
