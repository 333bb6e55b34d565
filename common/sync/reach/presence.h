#pragma once
/// Which bodies that are only displayed a peer's world has to have: those that could touch, before
/// the next look, one that it simulates. The others are absent (Motion::kAbsent) and cost a step
/// nothing.

#include <utility>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/mode.h"
#include "common/sync/reach/zones.h"
#include "common/sync/roles.h"

namespace seam {

class Presence {
 public:
  /// All must outlive this. At first everything is near. `memory` says what is parked: that is
  /// never near.
  Presence(const SyncConfig& config, const World& world, const Roles& roles,
           const BodyMemory& memory);

  /// After a step; when a look is due, looks. Whether it did.
  bool LookIfDue();
  /// Whether a mechanism that is only displayed has to be there.
  bool Near(int mechanism) const { return near_[static_cast<std::size_t>(mechanism)] != 0; }
  /// What is outside of it is near nothing that is simulated, for a second and more.
  const MovingBox& around() const { return around_; }
  /// By mechanism: 1 where what is simulated needs nobody near it while it sleeps. Until the next
  /// call, or until the bodies change.
  void LeaveUnwatched(std::vector<char> unwatched) { unwatched_ = std::move(unwatched); }
  /// The bodies have changed: everything is near until the next look.
  void Remap();

  /// Times a second, and how far ahead is looked, s: to the next look and what a blow can change on
  /// the way. What is near remains so for kNearKeep longer, s: to come and to go costs the world a
  /// new beginning.
  static constexpr int kLooksPerSecond = 10;
  static constexpr float kNearSeconds = 0.2f, kNearKeep = 0.5f;
  /// m from all that is simulated to the edge of around().
  static constexpr float kAround = 60;

 private:
  void Look();

  const SyncConfig& config_;
  const World& world_;
  const Roles& roles_;
  const BodyMemory& memory_;
  bool Unwatched(int body) const {
    const auto m = static_cast<std::size_t>(world_.mechanism(body));
    return m < unwatched_.size() && unwatched_[m] != 0 && !world_.awake(body);
  }

  std::vector<char> near_;       // by mechanism
  std::vector<char> unwatched_;  // by mechanism; empty: none
  MovingBox around_;
};

}  // namespace seam
