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

bool GrantAudience::Changed(const Change& change) const {
  const AuthorityRecord& now = replica_.authority().at(change.mechanism);
  return change.before.authority != now.authority || change.before.epoch != now.epoch;
}

PeerSet GrantAudience::ConcernedBy(const Change& change, const PeerSet& strangers) const {
  const AuthorityRecord& before = change.before;
  const AuthorityRecord& now = replica_.authority().at(change.mechanism);
  PeerSet came = now.secondaries, concerned = before.secondaries;
  came.Remove(before.secondaries);
  concerned.Remove(now.secondaries);
  concerned.Add(came);
  // The holder proposes the mechanism's edits, unless the server follows it.
  if (before.secondaries.Has(0) != now.secondaries.Has(0)) concerned.Add(now.authority);
  if ((OneFollower(before) < 0) != (OneFollower(now) < 0)) concerned.Add(now.authority);
  if (!Changed(change)) return concerned;
  concerned.Add(now.authority);
  concerned.Add(before.authority);
  concerned.Add(now.secondaries);
  concerned.Add(strangers);
  if (interest_.unknown()) return concerned;
  for (const int peer : interest_.ReceiversNear(change.mechanism)) concerned.Add(peer);
  return concerned;
}

void GrantAudience::Sort(const PeerSet& clients) {
  due_.assign(static_cast<std::size_t>(kPeersMax), {});
  PeerSet strangers;  // everything may be near to them
  clients.Each([&](int peer) {
    if (!interest_.Knows(peer)) strangers.Add(peer);
  });
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    const Change& change = changes_[i];
    if (change.asked > 0) {
      due_[static_cast<std::size_t>(change.asked)].push_back(i);
      continue;
    }
    PeerSet concerned = ConcernedBy(change, strangers);
    concerned.Keep(clients);
    concerned.Each([&](int peer) { due_[static_cast<std::size_t>(peer)].push_back(i); });
    PeerSet& owed = pending_->owed[change.mechanism];
    owed.Remove(concerned);
    if (!Changed(change)) continue;
    PeerSet others = clients;
    others.Remove(concerned);
    owed.Add(others);
    if (!others.empty()) pending_->any[change.mechanism] = 1;
  }
}

std::vector<Grants> GrantAudience::For(int peer) const {
  std::vector<Grants> out;
  for (const std::size_t i : due_[static_cast<std::size_t>(peer)]) {
    const Change& change = changes_[i];
    AuthorityRecord told = replica_.authority().at(change.mechanism);
    if (change.asked > 0) {
      told.secondaries.Add(peer);  // it goes on simulating until a grant names the new holder
      told.authority = 0;
      told.epoch = change.epoch;
    }
    Add(peer, change.mechanism, told, &out);
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
