#pragma once
/// Decides when a standby takes a room over before the lease of its holder has ended: the holder
/// was not seen live for kHolderSilentUs, and half of the players in the room knock meanwhile.
/// Neither is enough alone. A function of the times that it is given.

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

namespace seam {

class TakeOverRule {
 public:
  /// A holder is silent if its log has not grown for so long, us: 30 ticks at 60 Hz. Less and a
  /// busy disk is taken for a dead server; more and players wait longer.
  static constexpr std::int64_t kHolderSilentUs = 500000;
  /// Most time between two looks in which the standby did not work, us, normal 50 000: if it was
  /// longer, it is the standby that stood still, and its clock says nothing about the holder.
  static constexpr std::int64_t kLookGapUs = 250000;
  /// Time for which a knock counts, us; clients repeat it each 0.1 s.
  static constexpr std::int64_t kKnockCountsUs = 1000000;

  /// Notes a look at the holder; `lives`: it has done something since the last one; `worked_us`:
  /// CPU time that the standby has used since then.
  void NoteLook(std::int64_t now_us, bool lives, std::int64_t worked_us) {
    if (lives || now_us - looked_us_ - worked_us > kLookGapUs) live_us_ = now_us;
    seen_live_ = seen_live_ || lives;
    looked_us_ = now_us;
  }
  /// Notes another sign of life.
  void NoteAlive(std::int64_t now_us) { live_us_ = now_us; }
  /// True if the holder, which was seen live before, is not any more. One that never was may write
  /// into a folder that is not this server's.
  bool Silent(std::int64_t now_us) const {
    return seen_live_ && now_us - live_us_ >= kHolderSilentUs;
  }
  /// Notes a knock, proved to be of this player in the room.
  void NoteKnock(std::int64_t now_us, int player) { knocks_[player] = now_us; }
  /// Returns how many of these players have knocked since the holder was seen live, and lately.
  int Knocking(std::int64_t now_us, const std::vector<int>& present) const {
    return static_cast<int>(std::count_if(present.begin(), present.end(), [&](int player) {
      const auto knock = knocks_.find(player);
      return knock != knocks_.end() && knock->second > live_us_ &&
             now_us - knock->second < kKnockCountsUs;
    }));
  }
  /// True if the standby is to take the room over from its holder. `present`: the players in it.
  bool Due(std::int64_t now_us, const std::vector<int>& present) const {
    const int knocking = Knocking(now_us, present);
    return Silent(now_us) && knocking > 0 &&
           2 * static_cast<std::size_t>(knocking) >= present.size();
  }

 private:
  std::int64_t looked_us_ = INT64_MIN / 2, live_us_ = 0;
  bool seen_live_ = false;
  std::map<int, std::int64_t> knocks_;  // by player: the last
};

}  // namespace seam
