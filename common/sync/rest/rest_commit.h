#pragma once
/// Makes bodies rest at the same pose everywhere. Once an island has slept for .25 s, each
/// authority commits its own bodies: it sends their exact poses reliably. All other peers write
/// these poses unconditionally and hold the bodies there until the authority says otherwise.
///
///   authority   asleep .25 s --> commit --> Rest --> server (right, epoch) --> all other peers
///   receivers   Rest --> written, asleep, held --> a newer state of the authority ends it
///
/// This class trusts the physics: with rollback and in mode central all peers come to the same
/// sleep and waking from the same inputs, or one peer simulates everything. A held body that the
/// engine wakes is released. Only sleep of an input-complete tick is committed, because earlier
/// sleep may rest on an assumed input. A copy woken here goes back to rest if its authority stays
/// silent. DistrustedRest (common/sync/blend/) serves the modes whose copies differ.

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/display.h"
#include "common/sync/mode.h"
#include "common/sync/reach/reach.h"
#include "common/sync/rest/rest_blocks.h"
#include "common/sync/rest/rest_table.h"
#include "common/sync/rest/rest_watch.h"
#include "common/sync/roles.h"

namespace seam {

class RestCommit {
 public:
  /// All must outlive this. Does nothing where nobody sends states, or in a scene without
  /// sleep.
  RestCommit(const SyncConfig& config, World& world, const Roles& roles, BodyMemory& memory,
             Display& display, const Reach& reach);
  RestCommit(const RestCommit&) = delete;
  RestCommit& operator=(const RestCommit&) = delete;
  virtual ~RestCommit() = default;

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
  /// Forgets all rest.
  void StartAnew();
  /// Call after BodyMemory::Persist.
  void Persist(StateArchive& a);

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

 protected:
  /// Disturbances of a held body.
  struct Disturbance {
    std::int64_t released_tick = -1;  ///< when it was released here, its authority still silent;
                                      ///< -1: it was not
    int pushed_ticks = 0;             ///< ticks in a row; DistrustedRest
    int times = 0;                    ///< releases by pushes since its authority last spoke of it
  };

  /// Call before the decisions of a step.
  virtual void Prepare() {}
  /// True if a held, simulated body that is awake before a step is to be released.
  virtual bool IsDisturbed(int) const { return true; }
  /// Releases bodies of an island that the engine woke in the last step, or puts them back.
  virtual void HoldIsland(const std::vector<int>& island);
  /// True if these own bodies of an island may be committed though some are awake.
  virtual bool MayCommitAwake(const std::vector<int>&, const std::vector<int>&) const {
    return false;
  }
  /// Time after which a woken copy goes back to rest if its authority stays silent, s.
  virtual double BackAfter() const;

  const World& world() const { return world_; }
  const RestWatch& watch() const { return watch_; }
  bool Own(int body) const { return roles_.IsAuthority(world_.mechanism(body)); }
  int AuthorityOf(int body) const { return roles_.table().at(world_.mechanism(body)).authority; }
  Disturbance& disturbed(int body) { return disturbed_[body]; }
  std::int64_t Ticks(double seconds) const;
  /// Finds held and released bodies again after an edit.
  void FindHeld();
  /// Writes the body's rest pose, asleep; its view glides there.
  void Put(int body);
  /// Accepts a disturbance as real. The rest of an own body ends; a copy moves on until its
  /// authority speaks, or until it goes back.
  void LetGo(int body);

 private:
  bool Off() const { return !config_.policy->SendsStates() || !world_.scene().solver.sleep; }
  void EndOutdated(int body);
  void FindDue();
  void Hold(int body);
  void CommitIsland(const std::vector<int>& island);
  /// Number of the last ticks in which the body's motion rests on assumed inputs.
  std::int64_t Assumed(int body) const;
  bool LayThere(int body, std::int64_t ago) const;
  bool MayCommit(const std::vector<int>& island, const std::vector<int>& own) const;
  void Commit(int body);
  bool WokenSince(int body, std::int64_t tick, const BodyState& pose) const;
  bool ReceiveOne(const Rest& rest, std::size_t i);
  void WakeNeighbours(int body);

  const SyncConfig& config_;
  World& world_;
  const Roles& roles_;
  BodyMemory& memory_;
  Display& display_;
  const Reach& reach_;
  RestTable table_;
  RestWatch watch_;
  BodyColumn<Disturbance> disturbed_;
  std::vector<int> freed_;  // bodies released here, and some that no longer are
  std::vector<int> due_;    // bodies that this step has to check
  mutable int open_ = 0;    // a body that was not held at the last call of all()
  bool edited_ = false;
  std::vector<int> committed_;  // bodies, since the last Take; some twice
  std::int64_t number_ = 0;     // of the next Rest
  std::vector<Rest> waiting_;   // messages of future ticks
  EditHook after_edit_;
};

}  // namespace seam
