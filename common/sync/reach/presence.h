#pragma once
/// Chooses which bodies are in the Box2D world. A displayed body is, while it could touch a
/// simulated one before the next check; an own resting body is, while a moving one could touch it.
/// All other bodies are absent (Motion::kAbsent) and cost a step nothing.
///
///   simulated, awake   there
///   own, at rest       there if a mover could reach it, also through resting bodies; else idle
///   displayed          there if it could reach one of the above; else not near

#include <cstdint>
#include <utility>
#include <vector>

#include "common/base/spatial/box_index.h"
#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/mode.h"
#include "common/sync/peer_set.h"
#include "common/sync/reach/zones.h"
#include "common/sync/roles.h"
#include "common/sync/table/body_column.h"
#include "common/sync/table/mechanism_column.h"

namespace seam {

class Presence {
 public:
  /// All must outlive this. Initially, and after an edit that changes bodies, every mechanism is
  /// near until the next check. Bodies that `memory` has parked are never near.
  Presence(const SyncConfig& config, const World& world, const Roles& roles,
           const BodyMemory& memory);

  /// Call after a step. Repeats the check if it is due; returns true if it did.
  bool CheckIfDue();
  /// Call before a step. Repeats the check if Ask was called; returns true if it did.
  bool CheckIfRequested();
  /// Requests a check: a moving body is simulated here from now on and may be near bodies not
  /// needed until now.
  void Ask() { asked_ = true; }
  /// Mechanisms with another result in the last check than in the one before; ascending.
  const std::vector<int>& changed() const { return changed_; }
  /// True if a displayed mechanism has to be present.
  bool Near(int mechanism) const { return near_[mechanism] != 0; }
  /// True if a mechanism is this peer's own, at rest, and need not be present.
  bool Idle(int mechanism) const {
    const std::int32_t epoch = idle_[mechanism];
    return epoch != kNotIdle && epoch == roles_.table().at(mechanism).epoch &&
           roles_.RoleOf(mechanism) == kRoleAuthority;
  }
  /// Keeps a mechanism from being idle for a second, because something other than a body is about
  /// to move it. Returns true if it was idle.
  bool Need(int mechanism);
  /// Ends idleness of all mechanisms until the next check. Returns true if any was idle.
  bool NeedAll();
  /// Rectangle around all simulated bodies; anything outside stays far from them for more than a
  /// second.
  const MovingBox& around() const { return around_; }
  /// Sets the simulated mechanisms (1, by mechanism) that need no watching while asleep: each is
  /// handed to another peer before that peer's bodies touch it, so no displayed body need be near
  /// it, and it may be absent itself. Bodies of `doubtful` peers may touch it all the same. Holds
  /// until the next call or change of bodies.
  void LeaveUnwatched(std::vector<char> unwatched, const PeerSet& doubtful) {
    unwatched_ = std::move(unwatched);
    doubtful_ = doubtful;
  }
  /// Requires that no mechanism is idle (NeedAll).
  void Persist(StateArchive& a);

  /// Checks per second, and the time that each looks ahead, s: up to the next check, plus what an
  /// impact can change meanwhile. A near mechanism stays near for kNearKeep longer, s, because each
  /// change makes Box2D rebuild its world.
  static constexpr int kLooksPerSecond = 10;
  static constexpr float kNearSeconds = 0.2f, kNearKeep = 0.5f;
  /// The same for a moving and a resting body, s. Longer, because the mover's state may be one
  /// transit old, and the return of an absent resting body is cheap.
  static constexpr float kRestSeconds = 0.4f, kRestKeep = 0.2f;
  /// Margin between the simulated bodies and the edge of around(), m.
  static constexpr float kAround = 60;

 private:
  class Sorted;
  static constexpr std::int32_t kNotIdle = -1;
  /// Starts anew with the world's bodies.
  void Start();
  void Look();
  /// Sorts bodies into moving, displayed and resting ones.
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
  /// Rest records a resting body in this check; ForgetOthers drops those that no longer rest.
  void Rest(int body, std::uint64_t still);
  void ForgetOthers();
  void Reach(int mechanism);
  bool Needed(int mechanism) const { return needed_in_[mechanism] == looks_; }

  MechanismColumn<char> near_;
  std::vector<char> unwatched_;  // see LeaveUnwatched; empty: none
  PeerSet doubtful_;
  MechanismColumn<char> may_idle_;              // see MayIdle
  bool asked_ = false;                          // see Ask
  MechanismColumn<std::int32_t> idle_;          // its epoch when it became idle, or kNotIdle
  MechanismColumn<std::int64_t> needed_until_;  // tick, see Need
  std::vector<int> changed_;
  // Resting bodies are kept from check to check, since most have not moved.
  struct Rested {
    std::uint64_t still = 0;  // World::still at that time
    int seen_in = -1;         // last check in which it rested
    int changed_in = -1;      // last check before which it may have changed
  };
  BodyColumn<Rested> rested_;
  BoxIndex<MovingBox> resting_;
  std::vector<int> rests_;    // bodies in resting_; some rest no more
  float fastest_ = 0;         // speed of the fastest of them, m/s
  std::uint64_t change_ = 0;  // World::last_change at the last check
  std::vector<int> stirred_;  // bodies, for FindChanged
  MechanismColumn<char> lies_;  // in this check, if it may idle: all of its bodies rest
  int looks_ = 0;
  MechanismColumn<int> needed_in_;  // last check that needed it, see FindNeeded
  std::vector<int> needed_;         // resting bodies needed in this check
  // For this check; members only to reuse their memory, since a client checks ten times a second.
  std::vector<MovingBox> simulated_, movers_;
  std::vector<int> displayed_;  // bodies
  MechanismColumn<char> near_before_;
  MechanismColumn<std::int32_t> idle_before_;
  MovingBox around_;
  EditHook edited_;
};

}  // namespace seam
