#pragma once
/// Who has authority over each mechanism, who follows it, and since which epoch: the ledger that
/// every peer keeps from the server's grants.

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/scene/assembly.h"
#include "common/sync/peer_set.h"

namespace seam {

struct AuthorityRecord {
  int authority = 0;
  std::int32_t epoch = 0;
  PeerSet secondaries;
};

/// One entry per mechanism of the composition, by index. At first the server has everything.
class AuthorityTable {
 public:
  explicit AuthorityTable(const Composition& composition);

  int count() const { return static_cast<int>(records_.size()); }
  const AuthorityRecord& at(int mechanism) const {
    return records_[static_cast<std::size_t>(mechanism)];
  }
  PartId id(int mechanism) const { return ids_[static_cast<std::size_t>(mechanism)]; }
  /// The mechanism of that id, -1: none.
  int IndexOf(PartId id) const;

  /// Sets one entry (the server plans with this).
  void Set(int mechanism, const AuthorityRecord& record);
  /// The mechanisms have changed. Each takes what the first of those it comes from had, or
  /// `fresh` if it is new; of several the highest epoch, one on: earlier states are of others.
  void Remap(const Composition& composition, const std::vector<std::vector<int>>& from,
             const AuthorityRecord& fresh);
  /// Takes over a message; unknown mechanisms and older epochs are ignored. Returns the indices of
  /// the mechanisms whose entry changed.
  std::vector<int> Apply(const Grants& grants);
  /// Everything in as few messages as fit a datagram.
  std::vector<Grants> Export(std::int64_t utime, std::int64_t tick,
                             const std::vector<int>& mechanisms) const;

 private:
  std::vector<AuthorityRecord> records_;
  std::vector<PartId> ids_;
};

}  // namespace seam
