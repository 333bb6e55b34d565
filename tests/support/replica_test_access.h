#pragma once
/// Access for tests that corrupt a replica's world, as no caller of Replica may, and that watch its
/// queues.

#include <map>
#include <string>

#include "common/sync/replica.h"

namespace seam {

struct ReplicaTestAccess {
  static World& world(Replica& replica) { return replica.world_; }
  static BodyTable& table(Replica& replica) { return replica.table_; }
  /// True if the body is parked (Display::Leave) and `at` is outside the displayed area: its pose
  /// here is old, and nobody sees it.
  static bool OutOfSight(const Replica& replica, int body, const Vec2& at) {
    const MovingBox& seen = replica.activities_.around();
    const bool within =
        (at.array() >= seen.min.array()).all() && (at.array() <= seen.max.array()).all();
    return replica.memory_.parked(body) && !within;
  }
  static int OwnPlayer(const Replica& replica) { return replica.roles_.own_player(); }
  /// Returns the body's state after a past tick; nullptr if the peer did not simulate it then.
  static const BodyState* Past(const Replica& replica, int body, std::int64_t tick) {
    const bool steps = replica.world().activity(body) == Activity::kSimulated &&
                       replica.memory_.track(body).dynamic_since <= tick;
    return steps ? replica.memory_.history().At(tick, body) : nullptr;
  }
  /// Returns the lengths of the queues of edits, states and rest commits, by name.
  static std::map<std::string, std::size_t> Queues(const Replica& replica) {
    return {{"edits ordered", replica.queue_->size()},
            {"edits found", replica.found_.size()},
            {"edits awaited", replica.awaited_.size()},
            {"edits proposed", replica.proposals_.remembered()},
            {"states let go", replica.released_.size()},
            {"states waiting", replica.corrector_.waiting()},
            {"rests waiting", replica.rest_->waiting()}};
  }
};

}  // namespace seam
