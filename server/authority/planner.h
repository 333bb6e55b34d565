#pragma once
/// What the server wants: who should have authority over each mechanism, and who should follow it
/// in its buffer zone. Static regions from the scene; a pure function of what it is given.

#include <cstdint>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/authority.h"
#include "common/sync/mode.h"

namespace seam {

/// Who should have authority over one mechanism, and who should follow it.
struct PlannedAuthority {
  int authority = 0;
  PeerSet secondaries;
};

/// One entry per mechanism, by its index.
using AuthorityPlan = std::vector<PlannedAuthority>;

class Planner {
 public:
  Planner(const Scene& scene, const SyncConfig& config);

  /// One planned per mechanism. `peer_of_player[p]` is the peer that drives player p, or -1.
  ///
  ///   authority: the owner's peer if it is here; else the peer in whose region the mechanism's
  ///   root is (with kHysteresis before it leaves the one that has it, and kDwell between changes);
  ///   else the server. Secondary (mode buffer): peers whose region, or whose mechanisms, are
  ///   within the scene's buffer width.
  std::vector<PlannedAuthority> Plan(const World& world, const AuthorityTable& table,
                                     const std::vector<int>& peer_of_player);

  /// The mechanisms are others now; see BodyRemap.
  void Remap(const std::vector<std::vector<int>>& from);

  static constexpr float kHysteresis = 2.0f;  ///< m beyond the border before a hand-over
  static constexpr double kDwell = 0.5;       ///< s an authority lasts at least

 private:
  int WantedPlayer(const World& world, int mechanism, int current_player) const;

  const Scene& scene_;
  SyncConfig config_;
  std::vector<std::int64_t> changed_tick_;  // by mechanism
  std::vector<int> last_authority_;         // by mechanism
};

}  // namespace seam
