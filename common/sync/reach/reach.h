#pragma once
/// Finds the newest input-complete tick of each mechanism: the newest tick for which the inputs of
/// all players that can influence it are known here.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/inputs/input_track.h"
#include "common/sync/mode.h"
#include "common/sync/reach/driven.h"
#include "common/sync/reach/zones.h"
#include "common/sync/roles.h"

namespace seam {

class Reach {
 public:
  /// All must outlive this. `inputs`: by player.
  Reach(const SyncConfig& config, const World& world, const Roles& roles, const Drivers& drivers,
        const std::vector<InputTrack>& inputs)
      : config_(config), world_(world), roles_(roles), drivers_(drivers), inputs_(inputs) {}

  /// Call after a step. Finds mechanisms that may have met during the ticks with missing inputs.
  void Look();

  /// Returns the players that this peer waits for, with the number of newest ticks that
  /// lack their inputs. Players that are absent do not count.
  std::vector<std::pair<int, std::int64_t>> Missing() const;
  /// Returns the greatest of those numbers; 0 if nothing is missing.
  std::int64_t LongestMissing() const;
  /// Newest input-complete tick, at most the world's; -1 before the first Look. Requires a Look
  /// since the bodies changed. It does not fall while the missing players stay the same: a box that
  /// reaches the mechanism now did not reach it then.
  std::int64_t CompleteTick(int mechanism) const {
    if (looked_ < 0) return -1;  // grants may come before the first step
    return std::min(looked_, complete_[static_cast<std::size_t>(mechanism)]);
  }
  /// Newest tick that is input-complete for every mechanism. The same requirement.
  std::int64_t CompleteTickOfAll() const;

 private:
  /// True if this peer waits for the player's inputs.
  bool WaitsFor(int player) const;

  const SyncConfig& config_;
  const World& world_;
  const Roles& roles_;
  const Drivers& drivers_;
  const std::vector<InputTrack>& inputs_;
  static constexpr std::int64_t kComplete = INT64_MAX;
  std::int64_t looked_ = -1;            // tick of the last Look
  std::vector<std::int64_t> complete_;  // rebuilt by Look, by mechanism; kComplete: all
  std::vector<int> open_;               // mechanisms with missing inputs
  std::vector<char> waited_;            // by player: counted at the last Look
  int revision_ = -1;                   // of the bodies at the last Look
};

/// Returns the box of a body, without acceleration.
MovingBox BoxOf(const World& world, int body);

/// Returns the boxes of the world's bodies, grouped by mechanism. Only of present bodies,
/// unless `all_bodies`. A mechanism that any player drives can accelerate.
std::vector<MovingBox> BoxesOf(const World& world, const Drivers& drivers, bool all_bodies);
/// Returns the boxes of these bodies, in their order.
std::vector<MovingBox> BoxesOf(const World& world, const Drivers& drivers,
                               const std::vector<int>& bodies);

}  // namespace seam
