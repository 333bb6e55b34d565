#pragma once
/// Whether two peers know the same of what rests, block by block: each ping looks at one block of
/// the bodies, the next one at the next. What differs for a while is under way, what goes on to
/// differ was lost and has to be said again: so much of it as the block has.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/codec/message_limits.h"

namespace seam {

/// About the least bodies of a block: what a ping looks at is little, and how long it takes until
/// all have had their turn does not grow with the room.
constexpr int kRestBlockBodies = 20;

/// Of all bodies by ascending id one of `blocks` equal parts.
struct RestBlock {
  int blocks = 0;  ///< 0: nothing is looked at
  int block = 0;   ///< from 0

  /// The block whose turn it is, of so many bodies.
  static RestBlock Of(int bodies, std::int64_t turn) {
    const int blocks = std::clamp(bodies / kRestBlockBodies, 1, kRestBlocksMax);
    return {blocks, static_cast<int>(turn % blocks)};
  }
  /// Indices of its bodies: the first one, and the one behind the last.
  int begin(int bodies) const { return At(bodies, block); }
  int end(int bodies) const { return At(bodies, block + 1); }

 private:
  int At(int bodies, int i) const {
    return blocks < 1 ? 0 : static_cast<int>(std::int64_t{bodies} * i / blocks);
  }
};

class RestBlocks {
 public:
  /// A ping came with `theirs` of a block, while ours is `ours`. True: say again what rests of it.
  bool Lost(std::int64_t now_us, const RestBlock& at, std::uint64_t ours, std::uint64_t theirs) {
    Difference& known = At(at);
    if (ours == theirs) {
      known = Difference{};
      return false;
    }
    if (known.any_us < 0) known.any_us = now_us;
    if (ours != known.ours || theirs != known.theirs) known = {ours, theirs, now_us, known.any_us};
    const bool lost = now_us - known.since_us >= kPatienceUs ||
                      now_us - known.any_us >= kPatienceMovingUs + at.blocks * kTurnUs;
    if (lost) known.since_us = known.any_us = now_us;
    return lost;
  }
  /// Nothing can be said of a block now: not all that rests of it was told.
  void Skip(const RestBlock& at) { At(at) = Difference{}; }

 private:
  /// More than a message takes on a slow path, and no less than two pings of a quiet room, us.
  static constexpr std::int64_t kPatienceUs = 1000000;
  /// Where something comes to rest or wakes all the time, us: what is under way differs then, too.
  /// And about two pings more for each block.
  static constexpr std::int64_t kPatienceMovingUs = 3000000, kTurnUs = 200000;

  struct Difference {
    std::uint64_t ours = 0, theirs = 0;
    std::int64_t since_us = -1;  // of this difference
    std::int64_t any_us = -1;    // of any; -1: there is none
  };
  Difference& At(const RestBlock& at) {
    const auto blocks = static_cast<std::size_t>(at.blocks);
    if (blocks_.size() != blocks) blocks_.assign(blocks, Difference{});
    return blocks_[static_cast<std::size_t>(at.block)];
  }

  std::vector<Difference> blocks_;
};

}  // namespace seam
