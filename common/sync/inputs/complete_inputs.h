#pragma once
/// The newest tick up to which all players' inputs are known: lockstep steps no further, and a
/// rollback of inputs not much further.

#include <cstdint>
#include <vector>

#include "common/sync/inputs/input_track.h"

namespace seam {

class CompleteInputs {
 public:
  /// `inputs`: by player; must outlive this. All inputs of `tick` and before it count as known.
  explicit CompleteInputs(const std::vector<InputTrack>& inputs, std::int64_t tick = 0)
      : inputs_(inputs), known_until_(inputs.size(), tick) {}
  void StartAt(std::int64_t tick) { known_until_.assign(inputs_.size(), tick); }

  /// Returns that tick; kAll without players.
  std::int64_t Tick() const;
  static constexpr std::int64_t kAll = std::int64_t{1} << 60;

 private:
  const std::vector<InputTrack>& inputs_;
  mutable std::vector<std::int64_t> known_until_;  // by player; each call looks from there
};

}  // namespace seam
