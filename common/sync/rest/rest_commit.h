#pragma once
/// Makes bodies rest at the same pose everywhere. Once an island has slept for .25 s, each
/// authority commits its own bodies: it sends their exact poses reliably. All other peers write
/// these poses unconditionally and hold the bodies there until the authority says otherwise.
///
///   authority   asleep .25 s --> commit --> Rest --> server (right, epoch) --> all other peers
///   receivers   Rest --> written, asleep, held --> a newer state of the authority ends it
///
/// A held body does not wake from a small disturbance. It wakes when its speed exceeds kWakeShare
/// times the engine's sleep threshold for some ticks in a row, or from an impact, an edit or an
/// input. A copy woken here goes back to rest if its authority stays silent.
/// If an island has several owners, their copies differ and the engine may never let them sleep. A
/// peer then commits its own bodies once they have lain still, whatever the copies do; if that
/// fails, the lowest peer commits, and finally every peer.
/// Rules that stamp inputs need none of this: their copies are equal and wake and sleep alike. They
/// commit only sleep of an input-complete tick, because earlier sleep may rest on an assumed input.

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/display.h"
#include "common/sync/input_track.h"
#include "common/sync/mode.h"
#include "common/sync/reach/driven.h"
#include "common/sync/reach/reach.h"
#include "common/sync/rest/rest_blocks.h"
#include "common/sync/rest/rest_table.h"
#include "common/sync/rest/rest_watch.h"
#include "common/sync/roles.h"

namespace seam {

class RestCommit {
 public:
  /// All must outlive this. `inputs`: by player. Does nothing in mode oracle or in a scene without
  /// sleep.
  RestCommit(const SyncConfig& config, World& world, const Roles& roles, const Drivers& drivers,
             BodyMemory& memory, Display& display, const std::vector<InputTrack>& inputs,
             const Reach& reach);

  /// Call immediately before a step. Puts each held body exactly at its rest pose.
  void BeforeStep();
  /// Call after a step, once its contacts are noted. Holds or releases the bodies that were woken
  /// and commits those that have come to rest.
  void AfterStep();
  /// Call after a change of roles, which recreates bodies. Puts held bodies back to their rest
  /// poses, asleep.
  void PutBack();
  /// Call when an edit was applied: a body that is awake before the next step was woken by it.
  void MarkEdited() { edited_ = true; }
  void Remap(const BodyRemap& change);
  /// Forgets all rest.
  void StartAnew();

  /// Takes commitments of another peer. Ignores entries older than a known state or commitment;
  /// keeps a message of a future tick until that tick. Returns true if it was the first word of any
  /// body's pose.
  bool Receive(const Rest& rest);
  /// Call after a hand-over has placed the copies. A body handed over exactly at its rest pose
  /// stays at rest; its new authority commits it again under its own epoch.
  void ProlongHandedOver(const ExactStates& exact);
  /// Returns the commitments of the last step. `utime` is left 0.
  std::vector<Rest> Take();
  /// Returns all commitments, for a peer that joins.
  std::vector<Rest> Everything() const;
  /// Returns the commitments of these bodies (ascending) that are held, for a peer that missed
  /// them. The tick is raised to the current one, because that peer may have heard newer states
  /// meanwhile.
  std::vector<Rest> Again(const std::vector<int>& bodies) const;
  /// Like the above for one block; only bodies of authority `peer`, or all if `peer` is below 0.
  std::vector<Rest> Again(const RestBlock& at, int peer) const;

  /// True if the body is held at a committed rest: nothing may correct, replay or drive it.
  bool Holds(int body) const { return memory_.track(body).at_rest; }
  /// True if every body is held.
  bool all() const;
  /// Sum of the hashes of all commitments; 0 if there are none.
  std::uint64_t Hash() const { return table_.Hash(); }
  /// Lower 32 bits of that sum for one block; only bodies of authority `peer`, or all if `peer` is
  /// below 0.
  std::uint32_t HashOf(const RestBlock& at, int peer) const;
  /// The record of a body's rest.
  const RestRecord& record(int body) const { return table_.at(body); }
  /// Number of messages kept for a future tick.
  std::size_t waiting() const { return waiting_.size(); }

 private:
  /// Disturbances of a held body.
  struct Disturbance {
    std::int64_t released_tick = -1;  ///< when it was released here, its authority still silent;
                                      ///< -1: it was not
    int pushed_ticks = 0;          ///< ticks in a row
    int times = 0;                 ///< releases by pushes since its authority last spoke of it
  };

  bool Off() const { return config_.policy->IsOracle() || !world_.scene().solver.sleep; }
  /// True if the physics alone decides about waking and sleeping, and no body is held against it:
  /// all peers come to the same result from the same inputs, or one peer simulates everything.
  bool Trusts() const { return config_.policy->TrustsSleep(); }
  bool Own(int body) const { return roles_.IsAuthority(world_.mechanism(body)); }
  int AuthorityOf(int body) const { return roles_.table().at(world_.mechanism(body)).authority; }
  Disturbance& disturbed(int body) { return disturbed_[static_cast<std::size_t>(body)]; }
  std::int64_t Ticks(double seconds) const;
  void EndOutdated(int body);
  void FindDue();
  void Hold(int body);
  /// Valid between BeforeStep and AfterStep. False where inputs are trusted to wake the bodies that
  /// they move.
  bool Driven(int body) const {
    return !Trusts() && driven_[static_cast<std::size_t>(world_.mechanism(body))];
  }
  /// Writes the body's rest pose, asleep; its view glides there.
  void Put(int body);
  /// Accepts a disturbance as real. The rest of an own body ends; a copy moves on until its
  /// authority speaks, or until it goes back.
  void LetGo(int body);
  bool ExceedsWakeLimit(int body);
  void HoldIsland(const std::vector<int>& island);
  void CommitIsland(const std::vector<int>& island);
  bool MayCommit(const std::vector<int>& island, const std::vector<int>& own) const;
  void Commit(int body);
  bool WokenSince(int body, std::int64_t tick, const BodyState& pose) const;
  bool ReceiveOne(const Rest& rest, std::size_t i);
  void WakeNeighbours(int body);

  const SyncConfig& config_;
  World& world_;
  const Roles& roles_;
  const Drivers& drivers_;
  BodyMemory& memory_;
  Display& display_;
  const std::vector<InputTrack>& inputs_;
  const Reach& reach_;
  RestTable table_;
  RestWatch watch_;
  std::vector<Disturbance> disturbed_;  // by body
  std::vector<bool> driven_;            // by mechanism: an input of this step moves it
  std::vector<int> freed_;              // bodies released here, and some that no longer are
  std::vector<int> due_;                // bodies that this step has to check
  mutable int open_ = 0;                // a body that was not held at the last call of all()
  bool edited_ = false;
  std::vector<int> committed_;  // bodies, since the last Take; some twice
  std::int64_t number_ = 0;     // of the next Rest
  std::vector<Rest> waiting_;   // messages of future ticks
};

}  // namespace seam
