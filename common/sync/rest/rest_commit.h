#pragma once
/// Rest that is the same everywhere. An island that has slept for a quarter of a second is
/// committed by its bodies' authorities: each sends its own bodies' exact poses, reliably; the
/// others write them unconditionally and hold them there until the authority says otherwise.
///
///   authority   asleep .25 s --> commit --> Rest --> server (right, epoch) --> everyone else
///   receivers   Rest --> written, asleep, held --> a newer state of the authority's ends it
///
/// Small disturbances do not wake what is held: kWakeShare times the engine's threshold, for some
/// ticks on end, a blow, an edit or an input does. A copy that was woken here while its authority
/// says nothing goes back to rest. Where an island has several owners their copies differ, and the
/// engine may never let them sleep: there a peer commits its own bodies when they have lain still
/// whatever the copies do, and if that does not come about, the lowest peer's and then everybody's.
/// Rules that stamp inputs need neither: their copies are the same, so they wake and sleep alike.
/// They commit what sleeps at an input-complete tick: sleep before that may be an assumption.

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
  /// All must outlive this. `inputs`: by player. Does nothing in mode oracle, and where
  /// the scene lets nothing sleep.
  RestCommit(const SyncConfig& config, World& world, const Roles& roles, const Drivers& drivers,
             BodyMemory& memory, Display& display, const std::vector<InputTrack>& inputs,
             const Reach& reach);

  /// Immediately before a step: what is held is exactly where it rests.
  void BeforeStep();
  /// After a step, its contacts noted: what was woken is held or let go, what has come to rest is
  /// committed.
  void AfterStep();
  /// After a change of roles, which makes bodies anew: what is held is where it rests, and asleep.
  void PutBack();
  /// An edit was applied: what is awake before the next step was woken by it.
  void NoteEdit() { edited_ = true; }
  void Remap(const BodyRemap& change);
  /// Nothing is known to rest any more.
  void StartAnew();

  /// What other peers' authorities have committed. What is older than a newer state or commitment
  /// is ignored; what is of a tick still to come waits for it. True: it was the first to say where
  /// a body is.
  bool Receive(const Rest& rest);
  /// Where its holder let go of bodies, after the copies were put there. What was handed over as it
  /// rests lies on: its new authority says so under its own epoch.
  void NoteHandedOver(const ExactStates& exact);
  /// What this peer committed in the last step; `utime` is left 0.
  std::vector<Rest> Take();
  /// All that rests, for one who joins.
  std::vector<Rest> Everything() const;
  /// What is held of these bodies (ascending), for one who has not heard of it yet or has lost it,
  /// and may have heard something else since: it lies so after this tick, too.
  std::vector<Rest> Again(const std::vector<int>& bodies) const;
  /// The same of a block; only what `peer` has authority over, unless below 0.
  std::vector<Rest> Again(const RestBlock& at, int peer) const;

  /// Whether the body lies committed, and is to be corrected, replayed and driven by nothing.
  bool Holds(int body) const { return memory_.track(body).at_rest; }
  /// Whether every body lies so.
  bool all() const;
  /// The sum of the hashes of all that is committed; 0: nothing.
  std::uint64_t Hash() const { return table_.Hash(); }
  /// The same of a block, its lower 32 bits; only what `peer` has authority over, unless below 0.
  std::uint32_t HashOf(const RestBlock& at, int peer) const;
  /// What is known of a body's rest.
  const RestRecord& record(int body) const { return table_.at(body); }
  /// Messages of ticks still to come.
  std::size_t waiting() const { return waiting_.size(); }

 private:
  /// What disturbed a body that is held.
  struct Disturbance {
    std::int64_t freed_tick = -1;  ///< it was let go here, its authority has not said so
    int pushed_ticks = 0;          ///< on end
    int times = 0;                 ///< it gave way to pushes since its authority last spoke of it
  };

  bool Off() const { return config_.mode == Mode::kOracle || !world_.scene().solver.sleep; }
  /// Where all peers come to the same by the same inputs, what the physics wakes is awake, and what
  /// it lets sleep sleeps: nothing is held against it. Likewise where one peer has all of it.
  bool Trusts() const {
    return config_.StampsInputs(roles_.self()) || config_.mode == Mode::kCentral;
  }
  bool Own(int body) const { return roles_.IsAuthority(world_.mechanism(body)); }
  int AuthorityOf(int body) const { return roles_.table().at(world_.mechanism(body)).authority; }
  Disturbance& disturbed(int body) { return disturbed_[static_cast<std::size_t>(body)]; }
  std::int64_t Ticks(double seconds) const;
  void EndOutdated(int body);
  void FindDue();
  void Hold(int body);
  /// Between BeforeStep and AfterStep; not where inputs are trusted to wake what they move.
  bool Driven(int body) const {
    return !Trusts() && driven_[static_cast<std::size_t>(world_.mechanism(body))];
  }
  /// Where and as it rests, its view gliding there.
  void Put(int body);
  /// The disturbance is real: an own body's rest is over, another's copy goes on until its
  /// authority speaks, or it goes back.
  void LetGo(int body);
  bool GivesWay(int body);
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
  std::vector<int> freed_;              // bodies that are let go, or were
  std::vector<int> due_;                // bodies that a step has to look at
  mutable int open_ = 0;                // the body that was found not to be held last
  bool edited_ = false;
  std::vector<int> committed_;  // since the last Take; some twice
  std::int64_t number_ = 0;     // of the next Rest
  std::vector<Rest> waiting_;   // of ticks still to come
};

}  // namespace seam
