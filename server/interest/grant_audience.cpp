#include "server/interest/grant_audience.h"

#include <algorithm>

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
  if (!pending_) pending_.emplace(replica_);
}

/// Every peer edits its table alike, so after an edit the record is as sent. The epoch of a
/// merged mechanism counts on from its parts' epochs: its authority must know it at once.
GrantAudience::Pending::Pending(const Replica& replica)
    : told(replica.table(),
           [&replica](int m, const std::vector<const AuthorityRecord*>&) {
             return replica.authority().at(m);
           }),
      owed(replica.table(), [](const PeerSet& before, PeerSet* into) { into->Add(before); }),
      any(replica.table(),
          [](const char& before, char* into) { *into = before != 0 ? before : *into; }),
      merged(replica.table(), [this](int m, const std::vector<const char*>& before) -> char {
        const auto set = [](const char* flag) { return *flag != 0; };
        const bool is = before.size() > 1 || std::any_of(before.begin(), before.end(), set);
        return any[m] != 0 && is ? 1 : 0;
      }) {
  for (int m = 0; m < told.size(); ++m) told[m] = replica.authority().at(m);
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
      AuthorityRecord& told = pending_->told[change.mechanism];
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
    const int m = change.mechanism;
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
      pending_->owed[m].Remove(peer);
    } else if (change.before.authority != now.authority || change.before.epoch != now.epoch) {
      pending_->owed[m].Add(peer);
      pending_->any[m] = 1;
    }
  }
  return out;
}

std::vector<Grants> GrantAudience::Owed(int peer, Which which) {
  std::vector<int> mechanisms;
  if (!pending_) return {};
  for (int m = 0; m < pending_->any.size(); ++m) {
    if (pending_->any[m] == 0 || !pending_->owed[m].Has(peer)) continue;
    const Relevance least = which == Which::kAll   ? Relevance::kNone
                            : which == Which::kFar ? Relevance::kFar
                                                   : Relevance::kNear;
    if (pending_->merged[m] != 0 || interest_.Of(peer, m) >= least) mechanisms.push_back(m);
  }
  return Owed(peer, mechanisms);
}

std::vector<Grants> GrantAudience::Owed(int peer, const std::vector<int>& mechanisms) {
  std::vector<Grants> out;
  if (!pending_) return out;
  for (const int m : mechanisms) {
    PeerSet& owed = pending_->owed[m];
    if (pending_->any[m] == 0 || !owed.Has(peer)) continue;
    owed.Remove(peer);
    if (owed.empty()) pending_->any[m] = pending_->merged[m] = 0;
    Add(peer, m, replica_.authority().at(m), &out);
  }
  return out;
}

void GrantAudience::NoteTold(int peer) {
  Begin();
  for (PeerSet& owed : pending_->owed) owed.Remove(peer);
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
