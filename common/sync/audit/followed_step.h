#pragma once
/// Follows the step of a character that is told of without it: an active character's step (its
/// side, its time, its target) is no part of its states, but follows from them. So a spare world
/// puts it anew at each told state, where its own controller goes on by what it sees:
///
///   told      told      told      told      told            a comparison, every fifth of a second
///     |- gain --|- gain --|- gain --|- gain --|   sum: ----------------------------------------> |
///
/// Which foot a standing character lifts first may be decided by less than the wire's rounding.
/// Its two sides are alike, so the step with the other foot is the same step with the sides
/// exchanged: this tries that where the feet go elsewhere.

#include <cstdint>
#include <optional>

#include "common/sync/audit/spare_world.h"

namespace seam {

class FollowedStep {
 public:
  /// Adds the gain of an interval that ends at `tick`; nullopt: it cannot be known. Returns true if
  /// the sides are to be exchanged now. `rest`: ticks between two trials.
  bool Add(std::int64_t tick, std::int64_t rest, const std::optional<Gain>& gain);
  /// Returns the sum since the last call. nullopt: a part of it is not known, or there is none.
  std::optional<Gain> Take();

 private:
  std::optional<Gain> sum_;
  bool unknown_ = false;
  double tried_ = -1;  // how fast parts went elsewhere before the trial, m/s; -1: no trial
  std::int64_t next_trial_ = 0;
};

}  // namespace seam
