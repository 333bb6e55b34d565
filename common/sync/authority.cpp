#include "common/sync/authority.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/base/state_archive.h"

namespace seam {
namespace {

/// Returns the entry of a mechanism made of these.
AuthorityRecord Merged(const std::vector<const AuthorityRecord*>& before,
                       const AuthorityRecord& fresh) {
  if (before.empty()) return fresh;
  AuthorityRecord record = *before.front();
  if (before.size() == 1) return record;
  for (std::size_t i = 1; i < before.size(); ++i) {
    record.epoch = std::max(record.epoch, before[i]->epoch);
    record.secondaries.Add(before[i]->secondaries);
    record.secondaries.Add(before[i]->authority);
  }
  record.epoch += 1;
  record.secondaries.Remove(record.authority);
  return record;
}

/// Returns how many followers a Grants lists of the record.
std::size_t ListedFollowers(const AuthorityRecord& record) {
  return std::min(static_cast<std::size_t>(record.secondaries.size()), kGrantFollowersMax);
}

}  // namespace

AuthorityTable::AuthorityTable(const Composition& composition, const BodyTable& table,
                               const AuthorityRecord& fresh)
    : records_(table,
               [fresh](int, const std::vector<const AuthorityRecord*>& before) {
                 return Merged(before, fresh);
               }),
      ids_(table, [&composition](int mechanism, const std::vector<const PartId*>&) {
        return composition.mechanisms[static_cast<std::size_t>(mechanism)].id;
      }) {
  SEAM_ASSERT(count() == static_cast<int>(composition.mechanisms.size()));
  for (int m = 0; m < count(); ++m) {
    ids_[m] = composition.mechanisms[static_cast<std::size_t>(m)].id;
  }
}

int AuthorityTable::IndexOf(PartId id) const {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  return found == ids_.end() || *found != id ? -1 : static_cast<int>(found - ids_.begin());
}

void AuthorityTable::Set(int mechanism, const AuthorityRecord& record) {
  SEAM_ASSERT(record.epoch >= at(mechanism).epoch);
  records_[mechanism] = record;
}

std::vector<int> AuthorityTable::Apply(const Grants& grants) {
  std::vector<int> changed;
  std::size_t follower = 0;
  for (std::size_t i = 0; i < grants.mechanism.size(); ++i) {
    AuthorityRecord next;
    next.authority = grants.authority[i];
    next.epoch = grants.epoch[i];
    for (int n = 0; n < grants.followers[i]; ++n) next.secondaries.Add(grants.follower[follower++]);
    const int index = IndexOf(grants.mechanism[i]);
    if (index < 0) continue;
    AuthorityRecord& now = records_[index];
    if (next.epoch < now.epoch) continue;
    if (next.authority == now.authority && next.epoch == now.epoch &&
        next.secondaries == now.secondaries) {
      continue;
    }
    now = next;
    changed.push_back(index);
  }
  return changed;
}

std::vector<Grants> AuthorityTable::Export(std::int64_t utime, std::int64_t tick,
                                           const std::vector<int>& mechanisms) const {
  return Export(utime, tick, mechanisms, [this](int m) { return at(m); });
}

std::vector<Grants> AuthorityTable::Export(
    std::int64_t utime, std::int64_t tick, const std::vector<int>& mechanisms,
    const std::function<AuthorityRecord(int)>& record_of) const {
  std::vector<Grants> out;
  for (const int m : mechanisms) {
    const AuthorityRecord record = record_of(m);
    const bool full = out.empty() || out.back().mechanism.size() >= kGrantsMax ||
                      out.back().follower.size() + ListedFollowers(record) > kGrantFollowersMax;
    if (full) {
      out.emplace_back();
      out.back().utime = utime;
      out.back().tick = tick;
    }
    AddRecord(id(m), record, &out.back());
  }
  return out;
}

void AddRecord(PartId id, const AuthorityRecord& record, Grants* grants) {
  const std::size_t followers = ListedFollowers(record);
  const std::size_t end = grants->follower.size() + followers;
  grants->mechanism.push_back(id);
  grants->authority.push_back(static_cast<std::int16_t>(record.authority));
  grants->epoch.push_back(record.epoch);
  grants->followers.push_back(static_cast<std::int16_t>(followers));
  record.secondaries.Each([&](int peer) {
    if (grants->follower.size() < end) grants->follower.push_back(static_cast<std::int16_t>(peer));
  });
}

void PeerSet::Persist(StateArchive& a) {
  std::vector<std::int16_t> peers;
  Each([&](int peer) { peers.push_back(static_cast<std::int16_t>(peer)); });
  a.List(&peers, words_.size() * kBits, [&](std::int16_t* p) { a.Int(p, 0, kPeersMax - 1); });
  words_.fill(0);
  for (const int peer : peers) Add(peer);
}

/// Most changes of a mechanism's authority.
constexpr std::int32_t kEpochMost = 1 << 30;

void AuthorityTable::Persist(StateArchive& a) {
  a.Section("authority");
  a.Exactly(&records_, [&](AuthorityRecord* record) {
    a.Int(&record->authority, 0, kPeersMax - 1);
    a.Int(&record->epoch, 0, kEpochMost);
    record->secondaries.Persist(a);
  });
}

}  // namespace seam
