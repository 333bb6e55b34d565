#pragma once
/// The inputs of a recording, applied to a world tick by tick; the oracle uses them.

#include <cstdint>
#include <map>
#include <vector>

#include "common/physics/world.h"
#include "common/record/recording.h"

namespace seam {

class RecordedInputs {
 public:
  /// Without any input.
  RecordedInputs() = default;
  RecordedInputs(const Recording& recording, const Scene& scene) { Add(recording, scene); }

  /// Reads the inputs of the players of `scene`. Overlapping messages agree; the first one is kept.
  void Add(const Recording& recording, const Scene& scene);
  /// Forgets the inputs before a tick, but the last one of each player.
  void Forget(std::int64_t before_tick);

  /// Sets a player's axes for `tick`, if they were recorded, and triggers the actions of buttons
  /// that go down. To be called before the step that makes `tick`.
  void Apply(World* world, int player, std::int64_t tick) const;
  /// Sets a player's axes to the last recorded ones up to `tick`; presses nothing.
  void Hold(World* world, int player, std::int64_t tick) const;
  /// True if holding the player's last input up to `known` equals the recorded inputs up to `tick`.
  bool Holds(int player, std::int64_t known, std::int64_t tick) const;
  /// Returns the players with recorded inputs, ascending.
  std::vector<int> players() const;

 private:
  using Ticks = std::map<std::int64_t, Input>;
  std::map<int, Ticks> by_player_;
};

}  // namespace seam
