#pragma once
/// Which bodies a peer's world has to have. Of those that are only displayed: what could touch,
/// before the next look, one that it simulates. Of its own that rest: what something that moves
/// could touch. The others are absent (Motion::kAbsent) and cost a step nothing.
///
///   simulated, awake   there
///   own, at rest       there if a mover could reach it, or one that such a one touches; else idle
///   displayed          there if it could reach one of these; else not near

#include <cstdint>
#include <utility>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/mode.h"
#include "common/sync/peer_set.h"
#include "common/sync/reach/kept_boxes.h"
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
  /// Before a step: the same if somebody has asked for one.
  bool LookIfAsked();
  /// What moves has begun to be simulated here: it may be near what was not needed until now.
  void Ask() { asked_ = true; }
  /// Mechanisms of which the last look has another answer than the one before; ascending.
  const std::vector<int>& changed() const { return changed_; }
  /// Whether a mechanism that is only displayed has to be there.
  bool Near(int mechanism) const { return near_[static_cast<std::size_t>(mechanism)] != 0; }
  /// Whether a mechanism is this peer's own, at rest, and nothing needs it to be there.
  bool Idle(int mechanism) const {
    const auto m = static_cast<std::size_t>(mechanism);
    return idle_[m] != kNotIdle && idle_[m] == roles_.table().at(mechanism).epoch &&
           roles_.RoleOf(mechanism) == kRoleAuthority;
  }
  /// Something that is no body is about to move the mechanism: it is not idle, for a second.
  /// Whether it was.
  bool Need(int mechanism);
  /// The same of all, until the next look.
  bool NeedAll();
  /// What is outside of it is near nothing that is simulated, for a second and more.
  const MovingBox& around() const { return around_; }
  /// By mechanism: 1 where what is simulated becomes somebody's before that peer's things touch it:
  /// while it sleeps it needs nobody near it, and need not be there itself. Things of `doubtful`
  /// peers may touch it all the same. Until the next call, or until the bodies change.
  void LeaveUnwatched(std::vector<char> unwatched, const PeerSet& doubtful) {
    unwatched_ = std::move(unwatched);
    doubtful_ = doubtful;
  }
  /// The bodies have changed: everything is near until the next look.
  void Remap();

  /// Times a second, and how far ahead is looked, s: to the next look and what a blow can change on
  /// the way. What is near remains so for kNearKeep longer, s: to come and to go costs the world a
  /// new beginning.
  static constexpr int kLooksPerSecond = 10;
  static constexpr float kNearSeconds = 0.2f, kNearKeep = 0.5f;
  /// The same for a mover and what rests, s: what is heard of the mover may be a way old besides,
  /// and what is aside costs little to come.
  static constexpr float kRestSeconds = 0.4f, kRestKeep = 0.2f;
  /// m from all that is simulated to the edge of around().
  static constexpr float kAround = 60;

 private:
  class Sorted;
  static constexpr std::int32_t kNotIdle = -1;
  void Look();
  /// Sorts what moves, what is only displayed, and what rests.
  void SortOut();
  void FindNeeded();
  void FindNear();
  void FindChanged();
  void FindIdle();

  const SyncConfig& config_;
  const World& world_;
  const Roles& roles_;
  const BodyMemory& memory_;
  bool Unwatched(int mechanism) const {
    const auto m = static_cast<std::size_t>(mechanism);
    return m < unwatched_.size() && unwatched_[m] != 0;
  }
  /// It rests, in this look; then: what rested in the one before and does no more.
  void Rest(int body, std::uint64_t still);
  void ForgetOthers();
  void Reach(int mechanism);
  bool Needed(int mechanism) const {
    return needed_in_[static_cast<std::size_t>(mechanism)] == looks_;
  }

  std::vector<char> near_;       // by mechanism
  std::vector<char> unwatched_;  // by mechanism; empty: none
  PeerSet doubtful_;
  std::vector<char> may_idle_;              // by mechanism, see MayIdle
  bool asked_ = false;                      // see Ask
  std::vector<std::int32_t> idle_;          // by mechanism: its epoch then; kNotIdle
  std::vector<std::int64_t> needed_until_;  // by mechanism: tick, see Need
  std::vector<int> changed_;
  // What rests, by body: it is kept from look to look, since it mostly lies where it lay.
  struct Rested {
    std::uint64_t still = 0;  // World::still then
    int seen_in = -1;         // the last look in which it rested
    int changed_in = -1;      // the last look before which it may have been changed
  };
  std::vector<Rested> rested_;
  KeptBoxes resting_;
  std::vector<int> rests_;    // those that are kept; some rest no more
  float fastest_ = 0;         // m/s, of any of them
  std::uint64_t change_ = 0;  // World::last_change at the last look
  std::vector<int> stirred_;  // for FindChanged: bodies
  std::vector<char> lies_;    // of this look, by mechanism that may idle: all of it rests
  int looks_ = 0;
  std::vector<int> needed_in_;  // by mechanism: the last look that needed it, see FindNeeded
  std::vector<int> needed_;     // of this look: bodies that rest
  // Of this look; a client has ten in a second: their memory is used again.
  std::vector<MovingBox> simulated_, movers_;
  std::vector<int> displayed_;  // bodies
  std::vector<char> near_before_;
  std::vector<std::int32_t> idle_before_;
  MovingBox around_;
};

}  // namespace seam
