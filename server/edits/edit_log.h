#pragma once
/// The order of the room's edits: peers propose, the log gives numbers, everyone applies them in
/// that order. It keeps what waits, and of what was ordered only what the world owes to it; it says
/// what is to be sent and sends nothing itself.

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/edits/edit_order.h"
#include "common/topology/topology_fold.h"
#include "server/authority/authority_manager.h"

namespace seam {

class EditLog {
 public:
  /// `world` and `authority` must outlive it. Requires a world that has had no edits.
  EditLog(const World& world, const AuthorityManager& authority, int tick_hz);

  /// The server's own: ordered at the next tick, or as soon as its parts are in one hand. One that
  /// cannot be is dropped; Topology::Validate tells beforehand. False: kWaitingMax wait already.
  bool Add(const Edit& edit) { return Wait(edit, 0, world_.tick()); }
  /// The same of one that physics found after an earlier tick.
  bool Add(const Edit& edit, std::int64_t found) { return Wait(edit, 0, found); }

  enum class Verdict {
    kTaken,
    kStale,  ///< cannot be any more: somebody else's came first
    kNoRight,
    kImplausible,
    kTooMany,  ///< kWaitingMax of this peer wait already
  };
  /// A peer's. Requires a message that Decode accepted. What a peer has no right to costs a look at
  /// its parts, whatever it says.
  Verdict Propose(int peer, const EditOrder& proposal);

  /// What was decided in one go.
  struct Batch {
    std::vector<EditOrder> orders;  ///< for everyone, in this order
    std::int64_t stale = 0;         ///< peers' proposals that cannot be any more
  };
  /// Gives numbers to all that can be ordered now. They must be applied, one by one, each followed
  /// by NoteApplied, before the next call.
  Batch OrderPending(std::int64_t now_us);
  /// For each edit that waits, the mechanisms that should be in one hand for it.
  std::vector<std::vector<int>> WaitingMechanisms() const;

  /// Edits that wait to be ordered, of all peers.
  std::size_t waiting() const { return pending_.size(); }

  /// To be called after each edit was applied.
  void NoteApplied();

  // Mode oracle, where every peer applies its edits alone, in the tick in which they are found:
  /// What waits, instead of OrderPending; without numbers, and nothing waits any more.
  std::vector<Edit> TakePending();
  /// After an edit was applied, instead of NoteApplied: its order, for the record.
  EditOrder NoteAlone(const Edit& edit, std::int64_t now_us);

  /// Whether it is known that after `revision` edits the world is not made of `composition`.
  bool Differs(int revision, std::int64_t composition) const;
  /// Whether a peer that says so of itself has to be repaired: it differs, or has applied edits
  /// that there never were, or, with nothing more under way to it, so few that it lost its place.
  bool NeedsRepair(const Ping& ping, bool more_under_way) const;
  /// Tells a peer to begin anew; the history follows.
  EditOrder BeginAnew(std::int64_t now_us) const;
  /// What turns the scene into the world as it is, for one who joins or is repaired; empty: there
  /// has been no edit. The one place that decides how much of the past that needs: none of it. It
  /// is as long as what is there. Requires that all that was ordered has been applied.
  std::vector<Snapshot> History(std::int64_t now_us) const;

  /// Edits of one peer that may wait: a hostile one fills its own share.
  static constexpr int kWaitingMax = 1024;
  /// Compositions that are remembered, of the last so many edits: more than can be under way to a
  /// peer (a Link gives up with 4096).
  static constexpr int kHashesMax = 8192;

 private:
  struct Pending {
    Edit edit;
    int peer = 0;            // who proposed it
    std::int64_t since = 0;  // tick
    std::int64_t found = 0;  // tick after which it is to be
    int made_at = 0;         // of the joint that is to break: another in its place is not meant
  };

  bool Wait(const Edit& edit, int peer, std::int64_t found);
  std::int64_t TickOf(const Pending& pending) const;
  bool IsStale(const Pending& pending) const;
  std::vector<int> MechanismsOf(const Edit& edit) const;

  const World& world_;
  const AuthorityManager& authority_;
  const int tick_hz_;
  std::vector<Pending> pending_;  // in the order of coming
  std::array<int, kPeersMax> waiting_of_peer_{};
  int ordered_ = 0;                          // edits that have a number
  std::int64_t last_tick_ = 0;               // of the last of them
  std::deque<Edit> unapplied_;               // the last of them
  std::map<int, std::uint64_t> hash_after_;  // of the composition, by number of edits applied
  TopologyFold fold_;
};

}  // namespace seam
