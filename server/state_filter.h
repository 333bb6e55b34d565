#pragma once
/// Decides which of a peer's states are accepted: the peer has the right, the tick is near now and
/// newer than the body's last accepted one, and the state is plausible. The rest is dropped and
/// counted by reason, before any other peer receives it.

#include <cstdint>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/sync/replica.h"
#include "common/sync/table/body_column.h"
#include "server/authority/authority_manager.h"
#include "server/edits/edit_log.h"
#include "server/trust/plausible.h"
#include "server/trust/trust_ladder.h"

namespace seam {

class StateFilter {
 public:
  /// All must outlive this object. Dropped messages and entries are counted in `stats`. `trust`:
  /// only with kAct do doubts decide (Plausible); else a state counts if its body can have moved
  /// there at the speed limit.
  StateFilter(const Scene& scene, const Replica& replica, const AuthorityManager& authority,
              const EditLog& edits, TrustMode trust, Stats& stats);

  /// Returns the accepted entries of a message of `peer`, without bodies if there is none. Requires
  /// that the peer is ready. The result is valid until the next call.
  const States& Keep(std::int64_t now_us, int peer, const States& states);
  /// Like above, for a rest commit; it may be old, as reliable messages are under loss.
  Rest Keep(std::int64_t now_us, int peer, const Rest& rest);
  /// Like above, for the exact states of bodies that the peer has released.
  ExactStates KeepExact(int peer, const ExactStates& exact);
  /// Returns the bodies with a state, since the last call, that was dropped because it was outside
  /// the scene's bounds, but no farther away than twice the speed limit explains.
  std::vector<int> TakeOutside();
  /// True if states of the message have to wait for the server's copies of their tick.
  bool Waits(const States& states) const {
    return trust_ != TrustMode::kOff && plausible_.Waits(states);
  }
  /// Returns the doubts about accepted and refused states since the last call.
  std::vector<Doubt> TakeDoubts() { return plausible_.TakeDoubts(); }
  /// See Plausible::MayBreak.
  bool MayBreak(const Joint& joint) { return plausible_.MayBreak(joint); }
  /// See Plausible.
  void NoteEdit(const Edit& edit) { plausible_.NoteEdit(edit); }
  const Plausible& plausible() const { return plausible_; }

 private:
  /// True if the message's header is acceptable.
  bool HeaderAcceptable(int peer, const States& states);
  /// True if the i-th exact state, of a body that the peer has released, is acceptable.
  bool MayRelease(int peer, int body, const ExactStates& exact, std::size_t i);
  std::int32_t EpochOf(int body) const;
  /// A body's state by a message of that peer, tick, revision and epoch.
  struct Claim {
    int peer = 0;
    std::int64_t tick = 0;
    std::int32_t revision = 0, epoch = 0;
    BodyState state;
    bool rests = false;
  };
  /// True if the claim is acceptable; otherwise counts it as dropped.
  bool MayMove(int body, const Claim& claim);
  /// True if the last accepted state of the body is newer.
  bool Outdated(int body, const Claim& claim) const;
  bool Believed(int body, const Claim& claim);

  const Scene& scene_;
  const Replica& replica_;
  const AuthorityManager& authority_;
  const EditLog& edits_;
  Stats& stats_;
  const TrustMode trust_;
  Plausible plausible_;
  BodyColumn<char> outside_;  // 1: for TakeOutside
  bool any_outside_ = false;  // a body may be
  // Results for the last message; members so that their memory is reused.
  States kept_;
  std::vector<std::size_t> passed_;  // indices of the accepted entries
};

}  // namespace seam
