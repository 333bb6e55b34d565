#pragma once
/// Whether two peers know the same of what rests, by the hashes of their pings: what differs for a
/// while is under way, what goes on to differ was lost and has to be said again.

#include <cstdint>

namespace seam {

class RestAgreement {
 public:
  /// A ping came with `theirs`, while ours is `ours`. True: say again what rests.
  bool Lost(std::int64_t now_us, std::uint64_t ours, std::uint64_t theirs) {
    agrees_ = ours == theirs;
    if (agrees_ || differs_since_us_ < 0) differs_since_us_ = now_us;
    if (agrees_ || ours != ours_ || theirs != theirs_) {
      ours_ = ours;
      theirs_ = theirs;
      since_us_ = now_us;
    }
    const bool lost = !agrees_ && (now_us - since_us_ >= kPatienceUs ||
                                   now_us - differs_since_us_ >= kPatienceMovingUs);
    if (lost) since_us_ = differs_since_us_ = now_us;
    return lost;
  }
  /// Whether they were equal at the last ping.
  bool agrees() const { return agrees_; }

 private:
  /// More than a message takes on a slow path, and no less than two pings of a quiet room, us.
  static constexpr std::int64_t kPatienceUs = 1000000;
  /// Where something comes to rest or wakes all the time, us: what is under way differs then, too.
  static constexpr std::int64_t kPatienceMovingUs = 3000000;

  bool agrees_ = false;
  std::uint64_t ours_ = 0, theirs_ = 0;
  std::int64_t since_us_ = 0;           // of this difference
  std::int64_t differs_since_us_ = -1;  // of any; -1: no ping yet
};

}  // namespace seam
