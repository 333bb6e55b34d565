#pragma once
/// Block-wise comparison of two peers' rest commitments. Each ping carries the hash of one block of
/// bodies; the blocks take turns. A difference that is young is assumed to be in transit; one that
/// persists means a lost message, and only that block's commitments are sent again.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/codec/message_limits.h"

namespace seam {

/// Approximate minimum of bodies per block. Small, so that a ping compares little; the number of
/// blocks is capped (kRestBlocksMax), so that a full round does not grow with the room.
constexpr int kRestBlockBodies = 20;

/// One of `blocks` equal parts of all bodies, in ascending order of id.
struct RestBlock {
  int blocks = 0;  ///< 0: nothing is compared
  int block = 0;   ///< from 0

  /// Returns the block of turn `turn` in a room of `bodies` bodies.
  static RestBlock Of(int bodies, std::int64_t turn) {
    const int blocks = std::clamp(bodies / kRestBlockBodies, 1, kRestBlocksMax);
    return {blocks, static_cast<int>(turn % blocks)};
  }
  /// Body indices: the first of the block, and one past the last.
  int begin(int bodies) const { return At(bodies, block); }
  int end(int bodies) const { return At(bodies, block + 1); }

 private:
  int At(int bodies, int i) const {
    return blocks < 1 ? 0 : static_cast<int>(std::int64_t{bodies} * i / blocks);
  }
};

class RestBlocks {
 public:
  /// Compares our hash with `theirs` from a ping. Returns true if commitments of this block were
  /// lost and have to be sent again. `sent_us`: what we queued until then is sent
  /// (Link::SentUntilUs); a younger difference may wait for its turn.
  bool Lost(std::int64_t now_us, std::int64_t sent_us, const RestBlock& at, std::uint64_t ours,
            std::uint64_t theirs) {
    Difference& known = At(at);
    if (ours == theirs) {
      known = Difference{};
      return false;
    }
    if (known.any_us < 0) known.any_us = now_us;
    if (ours != known.ours || theirs != known.theirs) known = {ours, theirs, now_us, known.any_us};
    const bool lost = sent_us - known.since_us >= kLostAfterUs ||
                      sent_us - known.any_us >= kPatienceMovingUs + at.blocks * kTurnUs;
    if (lost) known.since_us = known.any_us = now_us;
    return lost;
  }
  /// Forgets the block's difference: not all of its commitments have been sent, so a comparison
  /// would mean nothing.
  void Skip(const RestBlock& at) { At(at) = Difference{}; }

 private:
  /// Time after which an unchanged difference counts as a loss, us: longer than a message takes on
  /// a slow path, and at least two pings of a quiet room.
  static constexpr std::int64_t kLostAfterUs = 1000000;
  /// Time after which any difference counts as a loss, us: where bodies come to rest or wake all
  /// the time, messages in transit keep changing it. kTurnUs, about two pings, is added per block.
  static constexpr std::int64_t kPatienceMovingUs = 3000000, kTurnUs = 200000;

  struct Difference {
    std::uint64_t ours = 0, theirs = 0;
    std::int64_t since_us = -1;  // when this difference began
    std::int64_t any_us = -1;    // when the blocks began to differ; -1: equal
  };
  Difference& At(const RestBlock& at) {
    const auto blocks = static_cast<std::size_t>(at.blocks);
    if (blocks_.size() != blocks) blocks_.assign(blocks, Difference{});
    return blocks_[static_cast<std::size_t>(at.block)];
  }

  std::vector<Difference> blocks_;
};

}  // namespace seam
