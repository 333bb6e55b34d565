#pragma once
/// For tests that make a replica's world go astray, as no caller of Replica may, and that watch
/// what it keeps.

#include <map>
#include <string>

#include "common/sync/replica.h"

namespace seam {

struct ReplicaTestAccess {
  static World& world(Replica& replica) { return replica.world_; }
  /// Whether what is at `at` is shown to nobody here, and lies where it was when it was left
  /// (Display::Leave).
  static bool OutOfSight(const Replica& replica, int body, const Vec2& at) {
    const MovingBox& seen = replica.presence_.around();
    const bool within =
        (at.array() >= seen.min.array()).all() && (at.array() <= seen.max.array()).all();
    return replica.memory_.parked(body) && !within;
  }
  /// Edits, states and rests that wait for something.
  static std::map<std::string, std::size_t> Queues(const Replica& replica) {
    return {{"edits ordered", replica.queued_.size()},
            {"edits found", replica.found_.size()},
            {"edits awaited", replica.awaited_.size()},
            {"edits proposed", replica.proposals_.remembered()},
            {"edits appointed", replica.outside_edits_.size()},
            {"states let go", replica.released_.size()},
            {"states waiting", replica.corrector_.waiting()},
            {"rests waiting", replica.rest_.waiting()}};
  }
};

}  // namespace seam
