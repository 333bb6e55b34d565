#pragma once
/// The inputs of a recording, given to a world tick by tick as the oracle gives them.

#include <cstdint>
#include <map>
#include <vector>

#include "common/physics/world.h"
#include "common/record/recording.h"

namespace seam {

class RecordedInputs {
 public:
  /// Of the players that `scene` has. Where pieces overlap they agree; the first one stands.
  RecordedInputs(const Recording& recording, const Scene& scene);

  /// Sets a player's axes for `tick`, if they were recorded, and does what its buttons going down
  /// do; before the step that makes `tick`.
  void Apply(World* world, int player, std::int64_t tick) const;
  /// Sets a player's axes to what was last recorded up to `tick`; presses nothing.
  void Hold(World* world, int player, std::int64_t tick) const;
  /// Whether who knows a player's inputs up to `known`, and holds the last one, is right up to
  /// `tick`.
  bool Holds(int player, std::int64_t known, std::int64_t tick) const;
  /// Players with recorded inputs, ascending.
  std::vector<int> players() const;

 private:
  using Ticks = std::map<std::int64_t, Input>;
  std::map<int, Ticks> by_player_;
};

}  // namespace seam
