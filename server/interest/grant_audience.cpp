#include "server/interest/grant_audience.h"

namespace seam {
namespace {

/// Returns the lowest client that follows the mechanism; -1: none. The holder needs to know of one
/// follower, since that one's world has to come to the same bits, but not of all.
int OneFollower(const AuthorityRecord& record) {
  int lowest = -1;
  record.secondaries.Each([&](int peer) {
    if (lowest < 0 && peer > 0 && peer != record.authority) lowest = peer;
  });
  return lowest;
}

}  // namespace

/// Starts from the current table: a client that joins is sent the whole table.
void GrantAudience::Begin() {
  if (!told_.empty()) return;
  const AuthorityTable& table = replica_.authority();
  const auto count = static_cast<std::size_t>(table.count());
  for (int m = 0; m < table.count(); ++m) told_.push_back(table.at(m));
  owed_.assign(count, PeerSet{});
  any_pending_.assign(count, false);
  merged_.assign(count, false);
}

void GrantAudience::Take(const std::vector<Grants>& changes) {
  Begin();
  changes_.clear();
  const AuthorityTable& table = replica_.authority();
  for (const Grants& grants : changes) {
    utime_ = grants.utime;
    for (std::size_t i = 0; i < grants.mechanism.size(); ++i) {
      Change change;
      change.mechanism = table.IndexOf(grants.mechanism[i]);
      if (change.mechanism < 0) continue;
      const AuthorityRecord& now = table.at(change.mechanism);
      AuthorityRecord& told = told_[static_cast<std::size_t>(change.mechanism)];
      change.before = told;
      if (grants.epoch[i] > now.epoch) {
        change.asked = now.authority;
        change.epoch = grants.epoch[i];
      } else {
        told = now;
      }
      changes_.push_back(change);
    }
  }
}

bool GrantAudience::Concerns(int peer, const Change& change, const AuthorityRecord& now) const {
  const AuthorityRecord& before = change.before;
  const bool changed = before.authority != now.authority || before.epoch != now.epoch;
  const bool followed = before.secondaries.Has(peer), follows = now.secondaries.Has(peer);
  if (followed != follows) return true;
  const bool holds = now.authority == peer;
  // The holder proposes the mechanism's edits, unless the server follows it.
  if (holds && before.secondaries.Has(0) != now.secondaries.Has(0)) return true;
  if (holds && (OneFollower(before) < 0) != (OneFollower(now) < 0)) return true;
  if (!changed) return false;
  return holds || before.authority == peer || follows ||
         interest_.Of(peer, change.mechanism) >= Relevance::kNear;
}

std::vector<Grants> GrantAudience::For(int peer) {
  std::vector<Grants> out;
  for (const Change& change : changes_) {
    const auto m = static_cast<std::size_t>(change.mechanism);
    const AuthorityRecord& now = replica_.authority().at(change.mechanism);
    if (change.asked > 0) {
      if (change.asked != peer) continue;
      AuthorityRecord nobody = now;
      nobody.secondaries.Add(peer);  // it goes on simulating until a grant names the new holder
      nobody.authority = 0;
      nobody.epoch = change.epoch;
      Add(peer, change.mechanism, nobody, &out);
    } else if (Concerns(peer, change, now)) {
      Add(peer, change.mechanism, now, &out);
      owed_[m].Remove(peer);
    } else if (change.before.authority != now.authority || change.before.epoch != now.epoch) {
      owed_[m].Add(peer);
      any_pending_[m] = true;
    }
  }
  return out;
}

std::vector<Grants> GrantAudience::Owed(int peer, Which which) {
  std::vector<int> mechanisms;
  for (std::size_t m = 0; m < owed_.size(); ++m) {
    if (!any_pending_[m] || !owed_[m].Has(peer)) continue;
    const auto mechanism = static_cast<int>(m);
    const Relevance least = which == Which::kAll   ? Relevance::kNone
                            : which == Which::kFar ? Relevance::kFar
                                                   : Relevance::kNear;
    if (merged_[m] || interest_.Of(peer, mechanism) >= least) mechanisms.push_back(mechanism);
  }
  return Owed(peer, mechanisms);
}

std::vector<Grants> GrantAudience::Owed(int peer, const std::vector<int>& mechanisms) {
  std::vector<Grants> out;
  if (owed_.empty()) return out;
  for (const int mechanism : mechanisms) {
    const auto m = static_cast<std::size_t>(mechanism);
    if (!any_pending_[m] || !owed_[m].Has(peer)) continue;
    owed_[m].Remove(peer);
    any_pending_[m] = !owed_[m].empty();
    merged_[m] = merged_[m] && any_pending_[m];
    Add(peer, mechanism, replica_.authority().at(mechanism), &out);
  }
  return out;
}

void GrantAudience::NoteTold(int peer) {
  Begin();
  for (PeerSet& owed : owed_) owed.Remove(peer);
}

void GrantAudience::Remap(const std::vector<std::vector<int>>& from) {
  if (told_.empty()) return;
  std::vector<PeerSet> owed(from.size());
  std::vector<bool> any_owed(from.size(), false), merged(from.size(), false);
  for (std::size_t m = 0; m < from.size(); ++m) {
    for (const int old : from[m]) {
      const auto o = static_cast<std::size_t>(old);
      owed[m].Add(owed_[o]);
      any_owed[m] = any_owed[m] || any_pending_[o];
      merged[m] = merged[m] || merged_[o];
    }
    merged[m] = any_owed[m] && (merged[m] || from[m].size() > 1);
  }
  owed_ = std::move(owed);
  any_pending_ = std::move(any_owed);
  merged_ = std::move(merged);
  told_.clear();
  const AuthorityTable& table = replica_.authority();
  for (int m = 0; m < table.count(); ++m) told_.push_back(table.at(m));
}

void GrantAudience::Add(int peer, int mechanism, const AuthorityRecord& record,
                        std::vector<Grants>* to) const {
  if (to->empty() || to->back().mechanism.size() >= kGrantsMax) {
    to->emplace_back();
    to->back().utime = utime_;
    to->back().tick = replica_.tick();
  }
  Grants& grants = to->back();
  grants.mechanism.push_back(replica_.authority().id(mechanism));
  grants.authority.push_back(static_cast<std::int16_t>(record.authority));
  grants.epoch.push_back(record.epoch);
  std::int16_t followers = 0;
  const int other = record.authority == peer ? OneFollower(record) : peer;
  for (const int follower : {0, other}) {
    if (follower < 0 || !record.secondaries.Has(follower)) continue;
    grants.follower.push_back(static_cast<std::int16_t>(follower));
    ++followers;
  }
  grants.followers.push_back(followers);
}

}  // namespace seam
