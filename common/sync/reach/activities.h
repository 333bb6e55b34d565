#pragma once
/// Decides the activity of each body (activity.h). No other class does.
///
///   this peer's role    result of the last check              in view    activity
///   holds or follows    may be dormant                                   kDormant
///   holds or follows    a mover could reach it, or awake                 kSimulated
///   displays            (rules that do not reckon: no check)             kKinematic
///   displays            near: could touch a simulated one                kPrescribed
///   displays            not near                              yes        kDisplayed
///   displays            not near                              no         kParked
///
/// The check runs ten times a second. A mover also reaches a body through resting ones.

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

class Activities {
 public:
  /// All must outlive this. Initially, and after an edit that changes bodies, every mechanism is
  /// near until the next check.
  Activities(const SyncConfig& config, World& world, const Roles& roles, BodyMemory& memory);

  /// Returns the activity that the body should have now.
  Activity Wanted(int body) const;
  /// Gives it to the body.
  void Update(int body);
  /// Call when a body that is kDisplayed goes out of every view. Requires that it sleeps.
  void Park(int body);
  /// Call before the body is written to or comes into view. Does nothing, and returns false, if it
  /// is not parked.
  bool Unpark(int body);
  void UnparkAll();
  /// Call before an edit. Unparks all bodies and ends dormancy until the next check: Update all if
  /// it returns true.
  bool NeedAll();

  /// Call after a step. Repeats the check if it is due; returns true if it did.
  bool CheckIfDue();
  /// Call before a step. Repeats the check if Ask was called; returns true if it did.
  bool CheckIfRequested();
  /// Requests a check: a moving body is simulated here from now on and may be near bodies not
  /// needed until now.
  void Ask() { asked_ = true; }
  /// Mechanisms with bodies that want another activity since the last check, ascending.
  const std::vector<int>& changed() const { return changed_; }
  /// Keeps a mechanism from being dormant for a second, because something other than a body is
  /// about to move it. Returns true if it was dormant.
  bool Need(int mechanism);
  /// Rectangle around all simulated bodies; anything outside stays far from them for more than a
  /// second.
  const MovingBox& around() const { return around_; }
  /// Sets the simulated mechanisms (1, by mechanism) that may be dormant while asleep: each is
  /// handed to another peer before that peer's bodies touch it, so no displayed body need be near
  /// it. Bodies of `uncertain` peers may touch it all the same. Holds until the next call or change
  /// of bodies.
  void AllowDormant(std::vector<char> allowed, const PeerSet& uncertain) {
    allowed_ = std::move(allowed);
    uncertain_ = uncertain;
  }
  /// Requires that no mechanism is dormant (NeedAll).
  void Persist(StateArchive& a);

  /// Checks per second, and the time that each looks ahead, s: up to the next check, plus what an
  /// impact can change meanwhile. A near mechanism stays near for kNearKeep longer, s, because each
  /// change makes Box2D rebuild its world.
  static constexpr int kLooksPerSecond = 10;
  static constexpr float kNearSeconds = 0.2f, kNearKeep = 0.5f;
  /// The same for a moving and a resting body, s. Longer, because the mover's state may be one
  /// transit old, and the return of a dormant body is cheap.
  static constexpr float kRestSeconds = 0.4f, kRestKeep = 0.2f;
  /// Margin between the simulated bodies and the edge of around(), m.
  static constexpr float kAround = 60;

 private:
  class Sorted;
  static constexpr std::int32_t kNotDormant = -1;
  bool Allowed(int mechanism) const {
    const auto m = static_cast<std::size_t>(mechanism);
    return m < allowed_.size() && allowed_[m] != 0;
  }
  /// Starts anew with the world's bodies.
  void Start();
  void Look();
  /// Sorts bodies into moving, displayed and resting ones.
  void SortOut();
  void FindNeeded();
  void FindNear();
  void FindStirred();
  void FindDormant();
  /// Rest records a resting body in this check; ForgetOthers drops those that no longer rest.
  void Rest(int body, std::uint64_t still);
  void ForgetOthers();
  void Reach(int mechanism);
  bool Needed(int mechanism) const { return needed_in_[mechanism] == looks_; }

  const SyncConfig& config_;
  World& world_;
  const Roles& roles_;
  BodyMemory& memory_;
  MechanismColumn<char> near_;  // if displayed, it has to be present
  std::vector<char> allowed_;   // see AllowDormant; empty: none
  PeerSet uncertain_;
  MechanismColumn<char> may_rest_;              // see MayBeDormant
  bool asked_ = false;                          // see Ask
  MechanismColumn<std::int32_t> dormant_;       // its epoch when it became so, or kNotDormant
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
  std::vector<int> rests_;      // bodies in resting_; some rest no more
  float fastest_ = 0;           // speed of the fastest of them, m/s
  std::uint64_t change_ = 0;    // World::last_change at the last check
  std::vector<int> stirred_;    // bodies, for FindStirred
  MechanismColumn<char> lies_;  // in this check, if may_rest_: all of its bodies rest
  int looks_ = 0;
  MechanismColumn<int> needed_in_;  // last check that needed it, see FindNeeded
  std::vector<int> needed_;         // resting bodies needed in this check
  // For this check; members only to reuse their memory, since a client checks ten times a second.
  std::vector<MovingBox> simulated_, movers_;
  std::vector<int> displayed_;  // bodies
  MovingBox around_;
  EditHook edited_;
};

}  // namespace seam
