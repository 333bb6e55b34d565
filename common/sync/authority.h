#pragma once
/// Authority, followers and epoch of each mechanism; every peer keeps this table from the server's
/// grants.

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

/// One entry per mechanism of the composition, by index. Initially the server has authority over
/// all.
class AuthorityTable {
 public:
  explicit AuthorityTable(const Composition& composition);

  int count() const { return static_cast<int>(records_.size()); }
  const AuthorityRecord& at(int mechanism) const {
    return records_[static_cast<std::size_t>(mechanism)];
  }
  PartId id(int mechanism) const { return ids_[static_cast<std::size_t>(mechanism)]; }
  /// Returns the mechanism of an id, or -1.
  int IndexOf(PartId id) const;

  /// Sets one entry; the server plans with this. The epoch must not decrease (asserted).
  void Set(int mechanism, const AuthorityRecord& record);
  void Persist(StateArchive& a);
  /// Rebuilds the table after an edit. Each mechanism takes the entry of the first mechanism that
  /// it comes from, or `fresh` if it is new. A merger of several takes their highest epoch plus
  /// one, because earlier states belong to other mechanisms.
  void Remap(const Composition& composition, const std::vector<std::vector<int>>& from,
             const AuthorityRecord& fresh);
  /// Applies a message; ignores unknown mechanisms and older epochs. Returns the indices of the
  /// mechanisms with a changed entry.
  std::vector<int> Apply(const Grants& grants);
  /// Packs these mechanisms' entries into as few messages as fit datagrams.
  std::vector<Grants> Export(std::int64_t utime, std::int64_t tick,
                             const std::vector<int>& mechanisms) const;

 private:
  std::vector<AuthorityRecord> records_;
  std::vector<PartId> ids_;
};

}  // namespace seam
