#include "common/sync/authority.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/base/state_archive.h"

namespace seam {
AuthorityTable::AuthorityTable(const Composition& composition) {
  for (const Mechanism& m : composition.mechanisms) ids_.push_back(m.id);
  records_.resize(ids_.size());
}

int AuthorityTable::IndexOf(PartId id) const {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  return found == ids_.end() || *found != id ? -1 : static_cast<int>(found - ids_.begin());
}

void AuthorityTable::Set(int mechanism, const AuthorityRecord& record) {
  SEAM_ASSERT(record.epoch >= at(mechanism).epoch);
  records_[static_cast<std::size_t>(mechanism)] = record;
}

void AuthorityTable::Remap(const Composition& composition,
                           const std::vector<std::vector<int>>& from,
                           const AuthorityRecord& fresh) {
  SEAM_ASSERT(from.size() == composition.mechanisms.size());
  std::vector<AuthorityRecord> records;
  ids_.clear();
  for (std::size_t m = 0; m < from.size(); ++m) {
    ids_.push_back(composition.mechanisms[m].id);
    AuthorityRecord h = fresh;
    for (std::size_t i = 0; i < from[m].size(); ++i) {
      const AuthorityRecord& then = at(from[m][i]);
      if (i == 0) {
        h = then;
        continue;
      }
      h.epoch = std::max(h.epoch, then.epoch);
      h.secondaries.Add(then.secondaries);
      h.secondaries.Add(then.authority);
    }
    if (from[m].size() > 1) {
      h.epoch += 1;
      h.secondaries.Remove(h.authority);
    }
    records.push_back(h);
  }
  records_ = std::move(records);
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
    AuthorityRecord& now = records_[static_cast<std::size_t>(index)];
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
  std::vector<Grants> out;
  for (int m : mechanisms) {
    const AuthorityRecord& record = at(m);
    const auto followers = static_cast<std::size_t>(record.secondaries.size());
    const bool full = out.empty() || out.back().mechanism.size() >= kGrantsMax ||
                      out.back().follower.size() + followers > kGrantFollowersMax;
    if (full) {
      out.emplace_back();
      out.back().utime = utime;
      out.back().tick = tick;
    }
    Grants& g = out.back();
    const std::size_t end = g.follower.size() + followers;
    g.mechanism.push_back(id(m));
    g.authority.push_back(static_cast<std::int16_t>(record.authority));
    g.epoch.push_back(record.epoch);
    g.followers.push_back(static_cast<std::int16_t>(followers));
    for (int peer = 0; g.follower.size() < end; ++peer) {
      if (record.secondaries.Has(peer)) g.follower.push_back(static_cast<std::int16_t>(peer));
    }
  }
  return out;
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
