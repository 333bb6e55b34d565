#pragma once
/// Decides which clients receive an authority change now and which later (large rooms only).
/// At once: clients that have or had a role in the mechanism, and clients near it. For all others
/// the change is pending until the mechanism comes near, until an edit merges it with another, or
/// for kGrantPendingS; for clients to which the mechanism is out of interest, until it comes into
/// interest or for kGrantPendingDistantS. A delay does no harm: states name their authority and its
/// epoch.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/sync/replica.h"
#include "common/sync/table/mechanism_column.h"
#include "server/interest/interest.h"

namespace seam {

class GrantAudience {
 public:
  /// Both must outlive this object.
  GrantAudience(const Replica& replica, const Interest& interest)
      : replica_(replica), interest_(interest) {}

  /// Takes the changes that are about to be sent, in the form for all clients: changes that the
  /// authority table already has, or requests to release, which the table follows later.
  void Take(const std::vector<Grants>& changes);
  /// Chooses the changes of the last Take that each of these clients is sent now; marks the other
  /// changes of authority or epoch as pending for it.
  void Sort(const PeerSet& clients);
  /// Returns the changes to send to the peer now, as of the last Sort.
  std::vector<Grants> For(int peer) const;
  /// Returns the peer's pending changes and clears them: all, or only those of mechanisms that are
  /// now at least kFar or kNear to it. Merged mechanisms are always included.
  enum class Which { kAll, kFar, kNear };
  std::vector<Grants> Owed(int peer, Which which);
  /// Like above, for these mechanisms.
  std::vector<Grants> Owed(int peer, const std::vector<int>& mechanisms);
  /// Clears all pending changes of a peer that was sent the whole table.
  void NoteTold(int peer);
  /// s for which a change is pending at most.
  static constexpr int kGrantPendingS = 2, kGrantPendingDistantS = 20;

 private:
  /// A mechanism with a changed record, or a request to its holder to release it.
  struct Change {
    int mechanism = 0;
    int asked = 0;           // the holder to ask, by a grant to nobody; 0: no request
    std::int32_t epoch = 0;  // the request's
    AuthorityRecord before;  // as last sent
  };
  /// Adds a record in the form for one peer. Listed followers: the server and the peer itself; for
  /// the holder, the server and one follower.
  void Add(int peer, int mechanism, const AuthorityRecord& record, std::vector<Grants>* to) const;
  bool Changed(const Change& change) const;  ///< its authority or epoch
  /// Returns the peers to tell at once: with a role in the mechanism, or near it. `strangers`:
  /// clients for which there was no Look.
  PeerSet ConcernedBy(const Change& change, const PeerSet& strangers) const;
  void Begin();
  /// Per mechanism, from the first Take on. Changes of merged mechanisms are pending for all peers
  /// to which one of a part is.
  struct Pending {
    explicit Pending(const Replica& replica);

    MechanismColumn<AuthorityRecord> told;  // as last sent
    MechanismColumn<PeerSet> owed;          // peers with a stale authority or epoch
    MechanismColumn<char> any;              // 1: owed is not empty, or was not at the last Owed
    MechanismColumn<char> merged;           // 1: merged by an edit, and pending since
  };

  const Replica& replica_;
  const Interest& interest_;
  std::int64_t utime_ = 0;
  std::vector<Change> changes_;
  std::vector<std::vector<std::size_t>> due_;  // by peer, of the last Sort: indices in changes_
  std::optional<Pending> pending_;
};

}  // namespace seam
