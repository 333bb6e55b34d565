#pragma once
/// Server-side rules of a room besides motion: triggers, damage, scores, scripts. Run once per tick
/// on the states of a RuleSource; request changes of the world through RoomCommands.

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/codec/lcm_types.h"
#include "common/physics/world.h"
#include "common/sync/metadata.h"
#include "server/rules/rule_source.h"
#include "server/rules/tearing.h"
#include "server/rules/triggers.h"

namespace seam {

class Script;
class ScriptRoom;
class StateArchive;
struct SavedScript;

/// Commands of the rules to the room. Changes reach every peer a little later.
class RoomCommands {
 public:
  virtual ~RoomCommands() = default;
  /// Each throws ScriptRefusal if it cannot be done.
  virtual void RemovePart(PartId part) = 0;
  virtual void BreakJoint(int joint) = 0;  ///< index into Scene::joints
  /// Makes b rigid with a in its current pose, up to `strength` N (0: for ever).
  virtual void Bond(PartId a, PartId b, float strength) = 0;
  virtual void Push(PartId part, const Vec2& impulse) = 0;
  /// Makes the part's active character limp for `seconds`; below 0 ends that.
  virtual void Limp(PartId part, float seconds) = 0;
  virtual void LeaveSeat(int seat) = 0;  ///< index into Scene::seats
  virtual void Blast(const Vec2& centre, float radius, float speed, float impulse) = 0;
  /// `text`: [[part]] and [[joint]] as in a scene file.
  virtual void Insert(const std::string& text) = 0;
  virtual void Say(const Event& event) = 0;
  /// Says a warning, and also prints the text on the operator's terminal.
  virtual void Warn(const std::string& text) = 0;
  virtual bool Present(int player) const = 0;
  virtual Input ReadInput(int player) const = 0;
};

/// News of a player and a seat.
enum class SeatNews { kGotIn, kGotOut, kTooFar, kTaken };

class Rules {
 public:
  static constexpr std::size_t kMessagesMax = 256;

  /// True if the scene has triggers, scripts, charges or parts with health; else no Rules are
  /// needed.
  static bool Needed(const Scene& scene);

  /// `world` and `commands` must outlive it. Loads the scripts; a wrong one is stopped at once, and
  /// reported after the first tick. `source`, if given, must outlive it; otherwise the rules use
  /// `world` alone.
  Rules(const World& world, std::int64_t seed, RoomCommands& commands,
        RuleSource* source = nullptr);
  ~Rules();

  /// Call after each tick of the world.
  void AfterTick();
  /// A player became ready, or left: scripts hear of it with the next tick.
  void OnJoin(int player);
  void OnLeave(int player);
  /// A player asked for a seat in vain: scripts hear of it likewise.
  void OnSeat(int player, int seat, SeatNews news) { seat_events_.push_back({player, seat, news}); }
  /// Queues a message of another program for the next tick. Returns false if kMessagesMax wait.
  bool Queue(LcmHeard message);
  /// Call before each tick: gives the queued messages to the scripts, which get them after the tick
  /// before all else, and returns them for the log.
  const std::vector<LcmHeard>& TakeQueued() { return messages_ = std::exchange(queued_, {}); }
  /// Gives a message of the log to the scripts in the same way.
  void OnMessage(LcmHeard message) { messages_.push_back(std::move(message)); }

  /// True if a script was stopped, and that has been told.
  bool stopped() const { return !stopped_reported_.empty(); }
  /// True if a script has a callback for touches. Their world has to watch them then.
  bool WantTouches() const;

  /// Saves or loads all of it. Reading starts the scripts anew, with their tables `room`.
  void Persist(StateArchive& a);

  const MetaTable& metadata() const { return table_; }
  /// Sets values that were announced before, in a tick that is done again.
  void Correct(const Meta& announced) { table_.Announce(announced); }
  std::vector<Meta> TakeChanges(std::int64_t utime) {
    return table_.TakeChanges(utime, world_.tick());
  }

 private:
  friend class ScriptRoom;
  struct PlayerEvent {
    int player = -1;
    bool joins = true;
  };
  struct SeatEvent {
    int player = -1, seat = -1;
    SeatNews news = SeatNews::kGotIn;
  };

  // rules.cpp
  void NoteNewParts();
  void RunTriggers();
  void RunTriggersAt(std::int64_t tick);
  void OnEntered(const TriggerEvent& event);
  void OnCheckpoint(const TriggerEvent& event);
  void OnPickup(const TriggerEvent& event);
  void NoteHazards(std::int64_t tick);
  void RunHazards();
  // rules_charges.cpp
  void RunCharges();
  void SetOff(const Charge& charge);
  void Blast(const BlastEdit& blast);  ///< throws ScriptRefusal
  // rules_damage.cpp
  void RunDamage();
  void Strike(const Blow& blow);
  void Hurt(PartId part, float amount, int by_player);
  void RunDeaths();
  void Die(PartId part);
  void BreakJoints(const std::vector<int>& joints);
  // rules_scripts.cpp
  void NoteSeats();
  void RunScripts();
  void ReportStopped(Script& script);
  // rules_persist.cpp
  void PersistScripts(StateArchive& a);

  const Scene& scene() const { return world_.scene(); }
  /// Starts the script of this index: anew, or as it was saved.
  std::unique_ptr<Script> StartScript(std::size_t index, const SavedScript* saved);
  bool Exists(PartId part) const;
  float Health(PartId part) const;
  std::string PlayerName(int player) const;
  /// Says what a trigger did for a player.
  void SayTrigger(int trigger, int player, const std::string& text);

  const World& world_;
  const std::int64_t seed_;
  RoomCommands& commands_;
  WorldSource own_world_;
  RuleSource& source_;
  Triggers triggers_;
  MetaTable table_;
  int last_checkpoint_ = 0;          // highest order in the scene
  std::size_t parts_noted_ = 0;      // parts with initial health set
  std::map<PartId, int> struck_by_;  // player, in this tick
  Violence violence_;                // in this tick
  std::set<PartId> dead_;
  std::vector<TriggerEvent> happened_;  // trigger events of this tick
  struct Stay {
    std::int64_t first = 0, last = 0;  // first and last tick known to be inside
    std::int64_t hurt = 0;             // ticks of damage applied so far
    std::int64_t silent = 0;           // ticks without a newer state
  };
  std::map<std::pair<int, PartId>, Stay> stays_;  // in hazards; by trigger, part
  std::vector<std::int64_t> charge_due_;          // by charge: tick at which it detonates
  std::vector<PlayerEvent> player_events_;
  std::vector<SeatEvent> seat_events_;
  std::vector<LcmHeard> queued_;      // not saved, as datagrams are not
  std::vector<LcmHeard> messages_;    // none between ticks
  std::vector<int> seated_;           // by seat: player after the last tick, -1: none
  std::unique_ptr<ScriptRoom> room_;  // host of the scripts
  std::vector<std::unique_ptr<Script>> scripts_;
  std::set<std::string> stopped_reported_;
};

}  // namespace seam
