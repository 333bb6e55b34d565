#pragma once
/// Follows the step of a character that is told of without it: an active character's step (its
/// side, its time, its target) is no part of its states, but follows from them. So a spare world
/// puts it anew at each told state, where its own controller goes on by what it sees:
///
///   told      told      told      told      told            a comparison, every fifth of a second
///     |- gain --|- gain --|- gain --|- gain --|   sum: ----------------------------------------> |
///
/// Which foot a standing character lifts first, and when a fallen one begins to get up, may be
/// decided by less than the wire's rounding. Where limbs go elsewhere this tries the others of
/// SpareWorld::TryOther, one for each interval, and keeps one that fits.

#include <cstdint>
#include <optional>

#include "common/sync/audit/spare_world.h"

namespace seam {

class FollowedStep {
 public:
  /// Adds the gain of an interval that ends at `tick`; nullopt: it cannot be known. Returns the
  /// number of the other that is to be tried now; nullopt: none. `rest`: ticks between two trials.
  std::optional<int> Add(std::int64_t tick, std::int64_t rest, const std::optional<Gain>& gain);
  /// Call if there is no such other.
  void NoOther() { trial_.reset(); }
  /// Returns the sum since the last call. nullopt: a part of it is not known, or there is none.
  std::optional<Gain> Take();

 private:
  struct Trial {
    int other = 0;
    double apart = 0;  // how fast parts went elsewhere before, m/s
  };

  std::optional<Gain> sum_;
  bool unknown_ = false;
  std::optional<Trial> trial_;
  std::int64_t next_trial_ = 0;
};

}  // namespace seam
