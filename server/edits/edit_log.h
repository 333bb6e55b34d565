#pragma once
/// Total order of the room's edits: peers propose, the log assigns numbers, everyone applies the
/// edits in that order. Keeps pending edits, and of ordered ones only their remaining effect on the
/// world. Returns the messages to send, and sends nothing itself.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/edits/edit_order.h"
#include "common/topology/topology_fold.h"
#include "server/authority/authority_manager.h"

namespace seam {

class StateArchive;

class EditLog {
 public:
  /// `world` and `authority` must outlive it. Requires a world without edits.
  EditLog(const World& world, const AuthorityManager& authority, int tick_hz);
  EditLog(const EditLog&) = delete;
  EditLog& operator=(const EditLog&) = delete;
  virtual ~EditLog() = default;

  /// Adds an edit of the server: ordered at the next tick, or as soon as its parts have one
  /// authority; if it cuts off the past (CutsOffPast), once the inputs of that tick are known.
  /// Dropped if impossible; Topology::Validate tells beforehand. Returns false if kWaitingMax are
  /// pending.
  bool Add(const Edit& edit) { return Wait(edit, 0, world_.tick()); }
  /// Adds an edit that physics found after an earlier tick.
  bool Add(const Edit& edit, std::int64_t found) { return Wait(edit, 0, found); }

  enum class Verdict {
    kTaken,
    kStale,  ///< impossible by now: another edit came first
    kNoRight,
    kImplausible,
    kTooMany,  ///< kWaitingMax of this peer are pending
  };
  /// Checks and adds a peer's edit. Requires a message that Decode accepted. A proposal without
  /// right costs only a look at its parts, whatever its contents.
  Verdict Propose(int peer, const EditOrder& proposal);

  /// Result of one OrderPending.
  struct Batch {
    std::vector<EditOrder> orders;  ///< for everyone, in this order
    std::int64_t stale = 0;         ///< peers' proposals that became impossible
    /// True if the orders are final and go on the bus; else NoteApplied returns those that do.
    bool numbered = true;
  };
  /// Notes an order of an earlier server that goes on here: the next number follows it, and the
  /// edit is not pending any more. It must be applied like one of OrderPending.
  void NoteOrdered(const EditOrder& order);
  /// Call before OrderPending where inputs act at their ticks. `tick`: the newest tick of which all
  /// inputs are known. An edit from outside that cuts off the past waits for those of its tick, and
  /// for the time in which other peers get them, but no longer than replays reach; later edits from
  /// outside wait behind it. An edit that is ordered before would part peers that know different
  /// inputs.
  void NoteComplete(std::int64_t tick) { complete_ = tick; }
  /// Numbers all edits that can be ordered now. The caller must apply them one by one, each
  /// followed by NoteApplied, before the next call.
  virtual Batch OrderPending(std::int64_t now_us);
  /// Returns for each pending edit the mechanisms that need one common authority.
  std::vector<std::vector<int>> WaitingMechanisms() const;

  /// Number of pending edits, of all peers.
  std::size_t waiting() const { return pending_.size(); }

  /// Call after each applied edit. Returns its order if it is not on the bus yet.
  virtual std::optional<EditOrder> NoteApplied(const Edit& edit, std::int64_t now_us);

  /// True if the composition after `revision` edits is known and is not `composition`.
  bool Differs(int revision, std::int64_t composition) const;
  /// True if a peer with this ping must be repaired: its composition differs, or it has applied
  /// more edits than exist, or, with nothing more in flight to it, so few that their hashes are
  /// forgotten.
  virtual bool NeedsRepair(const Ping& ping, bool more_under_way) const;
  /// Returns the order that makes a peer start over; the history follows.
  EditOrder BeginAnew(std::int64_t now_us) const;
  /// Returns the edits that turn the scene into the current world, for a peer that joins or is
  /// repaired; empty if there has been no edit. The size depends on the current world, not on the
  /// past: this is the one place that decides how much of the past is needed. Requires that every
  /// ordered edit has been applied.
  std::vector<Snapshot> History(std::int64_t now_us) const;

  /// Saves the pending edits. Requires that every ordered edit has been applied.
  void Persist(StateArchive& a);
  /// Continues with a world that has had edits before, of which `fold` has the effect.
  void GoOnFrom(const TopologyFold& fold);

  /// Most pending edits of one peer, so that a hostile one fills only its own share.
  static constexpr int kWaitingMax = 1024;
  /// Number of remembered compositions, of the latest edits: more than can be in flight to a peer
  /// (a Link gives up at 4096).
  static constexpr int kHashesMax = 8192;

 protected:
  const World& world() const { return world_; }
  int tick_hz() const { return tick_hz_; }
  int NextNumber() { return ordered_++; }
  /// Returns and clears the pending edits that are possible.
  std::vector<Edit> TakePending();

 private:
  struct Pending {
    Edit edit;
    int peer = 0;            // proposer
    std::int64_t since = 0;  // tick
    std::int64_t found = 0;  // tick after which it should apply; from outside: the first at which
                             // it could be ordered
    int made_at = 0;         // revision of the joint to break; a later joint in its place stays
  };

  bool Wait(const Edit& edit, int peer, std::int64_t found);
  std::int64_t TickOf(const Pending& pending) const;
  /// True if a peer may propose an edit of these parts: one of them is in its mechanisms, or all
  /// are anchored and only their impacts' authorities feel the load.
  bool HasRight(int peer, const std::vector<PartId>& parts) const;
  bool IsEarly(const Pending& pending) const;
  bool LacksInputs(const Pending& pending) const;
  bool IsStale(const Pending& pending) const;
  std::vector<int> MechanismsOf(const Edit& edit) const;

  const World& world_;
  const AuthorityManager& authority_;
  const int tick_hz_;
  std::vector<Pending> pending_;  // by time of arrival
  std::array<int, kPeersMax> waiting_of_peer_{};
  int ordered_ = 0;                          // number of ordered edits
  std::int64_t last_tick_ = 0;               // tick of the last of these
  std::int64_t complete_ = INT64_MAX;        // see NoteComplete
  std::map<int, std::uint64_t> hash_after_;  // composition, by number of edits applied
  TopologyFold fold_;
};

}  // namespace seam
