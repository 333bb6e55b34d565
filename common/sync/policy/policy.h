#pragma once
/// Policy: everything that a mode of synchronisation decides. Each mode is one type in a file of
/// its own; MakeSyncConfig chooses one object by name, and all other code asks that object instead
/// of testing the mode. Policies have no state.
///
///   mode      simulated by          clients             others' bodies
///   oracle    every peer, alone     send nothing        (nobody's)
///   central   the server            run ahead, go back  copies, or interpolated
///   strict    one authority each    send states         interpolated
///   touch     one authority each    send states         interpolated
///   buffer    one authority each    send states         copies near it, else reckoned
///   lockstep  every peer            send inputs, wait   (nobody's)
///   ggpo      every peer            send inputs, go back  (nobody's)

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/codec/messages.h"
#include "common/sync/edits/edit_queue.h"

namespace seam {

class Roles;
struct Scene;

class Policy {
 public:
  Policy() = default;
  Policy(const Policy&) = delete;
  Policy& operator=(const Policy&) = delete;
  virtual ~Policy() = default;

  /// Name of the mode, as flags and messages have it.
  virtual const char* mode() const = 0;
  /// Name of the prediction; "" in modes that have none.
  virtual const char* predict() const { return ""; }
  /// Short description, for pictures; "" if the name says it all.
  virtual std::string about() const { return ""; }

  // Who simulates.
  /// True if a peer simulates a copy of a mechanism of which it is not the authority.
  virtual bool Follows(const Roles& peer, int mechanism) const = 0;
  /// True if authority moves between peers while the session runs (PlanAuthority).
  virtual bool PlansAuthority() const { return false; }
  /// True if it goes to players by what they drive and touch alone, whatever the scene says.
  virtual bool PlansByTouch() const { return false; }
  /// True if the planner chooses for each mechanism which peers follow it.
  virtual bool PlansFollowers() const { return false; }
  /// True if the server simulates every body where physics finds edits, so that its world feels
  /// each load on an anchored part. Otherwise only the authority of the loading body does.
  virtual bool ServerFeelsAll() const { return true; }
  /// Clients that simulate a mechanism, as the server knows them.
  enum class Simulators { kAuthorityAndFollowers, kNear, kEveryone };
  virtual Simulators simulators() const { return Simulators::kAuthorityAndFollowers; }
  /// True if all peers simulate everything from the scene's scripts and apply the edits that they
  /// find by themselves. Each peer's view is then the truth; nobody sends states.
  virtual bool IsOracle() const { return false; }
  /// True if peers send each other inputs alone: each simulates everything from all players'
  /// inputs, and nobody sends states.
  virtual bool InputsOnly() const { return false; }
  bool SendsStates() const { return !IsOracle() && !InputsOnly(); }
  /// True if every peer applies by itself the edits that physics finds, after the tick in which it
  /// finds them.
  virtual bool AppliesFoundEdits() const { return IsOracle(); }
  /// Makes the queue of the edits that a peer is to apply.
  virtual std::unique_ptr<EditQueue> MakeEditQueue() const { return std::make_unique<EditQueue>(); }
  /// Returns the inputs that every peer knows of a tick without being told; `delay`: the room's
  /// input delay, ticks.
  virtual std::vector<Inputs> KnownInputs(const Scene& scene, std::int64_t tick, int delay) const;

  // Time. `self`: peer number.
  /// True if inputs act at their own tick at every peer that simulates what they move. Otherwise
  /// only the authority acts on buttons, when it hears of them.
  virtual bool StampsInputs(int self) const { return GoesBack(self); }
  /// True if a late input, or a state that differs, makes the peer go back and step again.
  virtual bool GoesBack(int self) const;
  /// True if the peer's world is rebuilt at every barrier tick (BarrierEvery). Two worlds come to
  /// the same bits only if both are rebuilt at the same ticks.
  virtual bool TakesBarriers(int self) const { return GoesBack(self); }
  /// True if the world is rebuilt after an edit as at a barrier.
  virtual bool BarriersAfterEdits(int self) const { return GoesBack(self); }
  /// Most ticks that a peer steps beyond the newest one of which it has all players' inputs.
  virtual std::int64_t MostAhead(int) const { return kAnyTicks; }
  static constexpr std::int64_t kAnyTicks = std::int64_t{1} << 60;
  /// Returns the input delay of a room whose scene has this one, ticks.
  virtual int InputDelay(int of_scene) const { return of_scene; }
  /// True if the server changes the input delay to what the inputs' ways need (DelayChooser).
  virtual bool AdaptsInputDelay() const { return false; }
  /// True if a peer that simulates a copy comes to its authority's state by itself, from the same
  /// inputs at the same ticks: it is sent only kRefreshHz states a second.
  virtual bool CopiesAgree() const { return false; }
  /// True if states, rest and edits are sent only of ticks whose inputs are all known.
  virtual bool SendsCompleteTicks() const { return false; }
  /// True if waking and sleep need no agreement between peers: the same inputs lead all to the same
  /// result, or one peer simulates everything. No body is then held against the physics.
  virtual bool TrustsSleep() const { return false; }
  /// True if a client steps ahead of the server, so that its inputs arrive in time.
  virtual bool RunsAhead() const { return false; }

  // Display and traffic.
  /// True if bodies that are only displayed are dead-reckoned to now and keep their mass. Otherwise
  /// they are interpolated between states of the past, and nothing can push them.
  virtual bool Reckons() const { return false; }
  /// True if a peer shows others' bodies at the past moment for which all inputs are known, as far
  /// as its settings let it (ShowAge).
  virtual bool ShowsPast(int self) const { return GoesBack(self); }
  /// True if the server sends each client what is relevant to it, within a budget. Otherwise
  /// everyone gets every message.
  virtual bool SelectsTraffic() const { return false; }
};

/// Names of all modes, in the order of help texts.
std::vector<std::string> ModeNames();

/// Returns the policy of a mode; nullptr for an unknown name. `predict`: of mode central, "own" or
/// "all". `rolls_back`: of mode buffer, NamedReconciler::rolls_back.
const Policy* FindPolicy(const std::string& mode, const std::string& predict, bool rolls_back);

/// Policy of recordings with an unknown mode. Answers every question with no.
const Policy& UnknownPolicy();

// One file each.
const Policy& OraclePolicy();
const Policy& CentralPolicy(bool all);  ///< all: clients predict everything, else what they drive
const Policy& StrictPolicy();
const Policy& TouchPolicy();
const Policy& BufferPolicy(bool rolls_back);
const Policy& LockstepPolicy(bool adaptive);  ///< adaptive: the server chooses the input delay
const Policy& GgpoPolicy();

}  // namespace seam
