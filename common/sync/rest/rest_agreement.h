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
    if (agrees_ || ours != ours_ || theirs != theirs_) {
      ours_ = ours;
      theirs_ = theirs;
      since_us_ = now_us;
      return false;
    }
    if (now_us - since_us_ < kPatienceUs) return false;
    since_us_ = now_us;
    return true;
  }
  /// Whether they were equal at the last ping.
  bool agrees() const { return agrees_; }

 private:
  /// More than a message takes on a slow path, and no less than two pings of a quiet room, us.
  static constexpr std::int64_t kPatienceUs = 1000000;

  bool agrees_ = false;
  std::uint64_t ours_ = 0, theirs_ = 0;
  std::int64_t since_us_ = 0;
};

}  // namespace seam
