#pragma once
/// The order of the room's edits: peers propose, the log gives numbers, everyone applies them in
/// that order. It keeps what waits, what was ordered, and what the world was made of after each; it
/// says what is to be sent and sends nothing itself.

#include <cstdint>
#include <map>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/edit_order.h"
#include "server/authority/authority_manager.h"

namespace seam {

class EditLog {
 public:
  /// `world` and `authority` must outlive it.
  EditLog(const World& world, const AuthorityManager& authority, int tick_hz);

  /// The server's own: ordered at the next tick, or as soon as its parts are in one hand. One that
  /// cannot be is dropped; Topology::Validate tells beforehand.
  void Add(const Edit& edit);

  enum class Verdict {
    kTaken,
    kStale,  ///< cannot be any more: somebody else's came first
    kNoRight,
    kImplausible,
  };
  /// A peer's. Requires a message that Decode accepted.
  Verdict Propose(int peer, const EditOrder& proposal);

  /// What was decided in one go.
  struct Batch {
    std::vector<EditOrder> orders;  ///< for everyone, in this order
    std::int64_t stale = 0;         ///< peers' proposals that cannot be any more
    bool just_full = false;         ///< the room has had kEditsMax edits, and gets no more
  };
  /// Gives numbers to all that can be ordered now. They must be applied before the next call.
  Batch OrderPending(std::int64_t now_us);
  /// For each edit that waits, the mechanisms that should be in one hand for it.
  std::vector<std::vector<int>> WaitingMechanisms() const;

  /// To be called after each edit was applied.
  void NoteComposition(int revision);
  /// Whether it is known that after `revision` edits the world is not made of `composition`.
  bool Differs(int revision, std::int64_t composition) const;
  /// Whether a peer that says so of itself has to be repaired: it differs, or has applied edits
  /// that there never were.
  bool NeedsRepair(const Ping& ping) const;
  /// Tells a peer to begin anew; the history follows.
  EditOrder BeginAnew(std::int64_t now_us) const;
  /// What turns the scene into the world as it is, for one who joins or is repaired. The one place
  /// that decides how much of the past that needs: all of it.
  const std::vector<EditOrder>& History() const { return ordered_; }

  /// Edits in the life of a room: who joins late gets them all.
  static constexpr std::size_t kEditsMax = 8192;

 private:
  struct Pending {
    Edit edit;
    int peer = 0;            // who proposed it
    std::int64_t since = 0;  // tick
  };

  void Wait(const Edit& edit, int peer);
  std::vector<int> MechanismsOf(const Edit& edit) const;

  const World& world_;
  const AuthorityManager& authority_;
  const int tick_hz_;
  std::vector<Pending> pending_;             // in the order of coming
  std::vector<EditOrder> ordered_;           // by number
  std::map<int, std::uint64_t> hash_after_;  // of the composition, by number of edits applied
  bool full_ = false;                        // no more edits
};

}  // namespace seam
