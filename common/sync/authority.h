#pragma once
/// Authority, followers and epoch of each mechanism; every peer keeps this table from the server's
/// grants.

#include <cstdint>
#include <functional>
#include <vector>

#include "common/codec/messages.h"
#include "common/scene/assembly.h"
#include "common/sync/peer_set.h"
#include "common/sync/table/mechanism_column.h"

namespace seam {

struct AuthorityRecord {
  int authority = 0;
  std::int32_t epoch = 0;
  PeerSet secondaries;
};

/// One entry per mechanism of the composition, by index. Initially the server has authority over
/// all. After an edit each mechanism has the entry of the first mechanism that it comes from. A
/// merger of several has their highest epoch plus one, because earlier states belong to other
/// mechanisms.
class AuthorityTable {
 public:
  /// `fresh`: entry of mechanisms that an edit has made anew. The composition is the one of the
  /// table's world, and must outlive this.
  AuthorityTable(const Composition& composition, const BodyTable& table,
                 const AuthorityRecord& fresh = AuthorityRecord());

  int count() const { return records_.size(); }
  const AuthorityRecord& at(int mechanism) const { return records_[mechanism]; }
  PartId id(int mechanism) const { return ids_[mechanism]; }
  /// Returns the mechanism of an id, or -1.
  int IndexOf(PartId id) const;

  /// Sets one entry; the server plans with this. The epoch must not decrease (asserted).
  void Set(int mechanism, const AuthorityRecord& record);
  void Persist(StateArchive& a);
  /// Applies a message; ignores unknown mechanisms and older epochs. Returns the indices of the
  /// mechanisms with a changed entry.
  std::vector<int> Apply(const Grants& grants);
  /// Packs these mechanisms' entries into as few messages as fit datagrams.
  std::vector<Grants> Export(std::int64_t utime, std::int64_t tick,
                             const std::vector<int>& mechanisms) const;
  /// Like the above, with `record_of(mechanism)` in place of the entries.
  std::vector<Grants> Export(std::int64_t utime, std::int64_t tick,
                             const std::vector<int>& mechanisms,
                             const std::function<AuthorityRecord(int)>& record_of) const;

 private:
  MechanismColumn<AuthorityRecord> records_;
  MechanismColumn<PartId> ids_;
};

/// Adds an entry to a message. Of more than kGrantFollowersMax followers the lowest are listed, the
/// server first: only a crowd of a large room has so many, and its clients are told the entry in
/// the form for each (GrantAudience).
void AddRecord(PartId id, const AuthorityRecord& record, Grants* grants);

}  // namespace seam
