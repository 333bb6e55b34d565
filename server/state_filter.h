#pragma once
/// What of a peer's states is believed: said by who may say it, of now, newer than all that was
/// believed of that body, and likely. The rest is dropped and counted by reason, before anybody
/// else hears of it.

#include <cstdint>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/sync/replica.h"
#include "server/authority/authority_manager.h"
#include "server/edits/edit_log.h"

namespace seam {

class StateFilter {
 public:
  /// All must outlive it. Dropped things are counted in `stats`.
  StateFilter(const Scene& scene, const Replica& replica, const AuthorityManager& authority,
              const EditLog& edits, Stats& stats);

  /// What is kept of a message of `peer`, which is ready; without bodies when it is nothing. It
  /// holds until the next call.
  const States& Keep(std::int64_t now_us, int peer, const States& states);
  /// The same of a commitment to rest; it may be old, as reliable messages are under loss.
  Rest Keep(std::int64_t now_us, int peer, const Rest& rest);
  /// What is kept of what a peer, which is ready, says of bodies that it has let go of.
  ExactStates KeepExact(int peer, const ExactStates& exact);
  /// Bodies that their authority, since the last call, has said to be outside the scene's bounds:
  /// dropped, but no further away than twice the speed limit explains.
  std::vector<int> TakeOutside() { return std::exchange(outside_, {}); }
  /// The bodies have changed.
  void Remap(const std::vector<BodyOrigin>& bodies);

 private:
  /// Whether the message as a whole may be looked at.
  bool MayLookAt(int peer, const States& states);
  /// Whether what a peer says of the i-th body, which it has let go of, counts.
  bool MayRelease(int peer, int body, const ExactStates& exact, std::size_t i);
  std::int32_t EpochOf(int body) const;
  /// Whether a body may be where a message of that peer, tick, revision and epoch says, in `state`.
  struct Claim {
    int peer = 0;
    std::int64_t tick = 0;
    std::int32_t revision = 0, epoch = 0;
    BodyState state;
    bool rests = false;
  };
  bool MayMove(int body, const Claim& claim);
  /// Whether what was believed of it is newer.
  bool Outdated(int body, const Claim& claim) const;
  bool Plausible(int body, std::int64_t tick, const BodyState& state) const;
  /// Whether it could have moved there since it was last believed at `times` the speed limit.
  bool Reachable(int body, std::int64_t tick, const Vec2& position, float times) const;

  struct LastAccepted {
    std::int64_t tick = -1;
    std::int32_t epoch = 0;
    Vec2 position{0, 0};
  };

  const Scene& scene_;
  const Replica& replica_;
  const AuthorityManager& authority_;
  const EditLog& edits_;
  Stats& stats_;
  std::vector<LastAccepted> accepted_;  // by body
  std::vector<int> outside_;
  // Of the last message: their memory is used again.
  States kept_;
  std::vector<std::size_t> passed_;  // its entries that are kept
};

}  // namespace seam
