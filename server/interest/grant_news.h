#pragma once
/// Whom a change of authority concerns, in a large room. Who has a role in the mechanism, or had,
/// and who is near it is told at once; the others are owed it until it comes near them, until an
/// edit makes it part of another, or for kOwedS; those to whom it is nothing until it comes to
/// concern them, or for kOwedNothingS. What they miss meanwhile they need for
/// nothing: states name their authority and its epoch.

#include <cstdint>
#include <vector>

#include "common/sync/replica.h"
#include "server/interest/interest.h"

namespace seam {

class GrantNews {
 public:
  /// Both must outlive it.
  GrantNews(const Replica& replica, const Interest& interest)
      : replica_(replica), interest_(interest) {}

  /// Changes that are about to be told, as everyone would be told them: of the authority's own
  /// table, or questions to a holder to let go, which the table follows later.
  void Take(const std::vector<Grants>& changes);
  /// What of the last Take a peer is to be told now; of the rest it is owed what it may need.
  std::vector<Grants> For(int peer);
  /// What a peer is owed, and no more from then on: all of it, what is at least far or near it by
  /// now; and in any case what an edit has made of several.
  enum class Which { kAll, kFar, kNear };
  std::vector<Grants> Owed(int peer, Which which);
  /// Of these mechanisms.
  std::vector<Grants> Owed(int peer, const std::vector<int>& mechanisms);
  /// A peer was told everything.
  void NoteTold(int peer);
  /// The mechanisms have changed; see BodyRemap. Of one made of several the epoch counts from
  /// theirs: its authority must know it at once.
  void Remap(const std::vector<std::vector<int>>& from);

  /// s that a peer is owed something at most.
  static constexpr int kOwedS = 2, kOwedNothingS = 20;

 private:
  /// A mechanism whose record has changed, or whose holder is asked to let go.
  struct Change {
    int mechanism = 0;
    int asked = 0;           // the holder that is told that nobody has it; 0: nobody is asked
    std::int32_t epoch = 0;  // of the question
    AuthorityRecord before;  // as it was told
  };
  /// Adds a record as it concerns a peer: of the followers only the server and itself, or for its
  /// holder one of them.
  void Add(int peer, int mechanism, const AuthorityRecord& record, std::vector<Grants>* to) const;
  bool Concerns(int peer, const Change& change, const AuthorityRecord& now) const;
  void Begin();

  const Replica& replica_;
  const Interest& interest_;
  std::int64_t utime_ = 0;
  std::vector<Change> changes_;
  std::vector<AuthorityRecord> told_;  // by mechanism: to whom it concerned
  std::vector<PeerSet> owed_;          // by mechanism: who knows another authority, or epoch
  std::vector<bool> any_owed_;         // by mechanism
  std::vector<bool> merged_;           // by mechanism: made of several, and owed since
};

}  // namespace seam
