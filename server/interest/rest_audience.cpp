#include "server/interest/rest_audience.h"

#include <algorithm>
#include <utility>

#include "common/scene/mechanism_ids.h"
#include "server/interest/pose_entry.h"

namespace seam {

void RestAudience::Take(const Rest& rest) {
  rest_ = rest;
  head_ = Rest{};
  head_.utime = rest.utime;
  head_.peer = rest.peer;
  head_.number = rest.number;
  head_.tick = rest.tick;
  head_.revision = rest.revision;
  head_.composition = rest.composition;
  mechanisms_.clear();
  const World& world = replica_.world();
  for (const std::int32_t id : rest.id) {
    const int body = world.BodyOfId(id);
    mechanisms_.push_back(body < 0 ? -1 : world.mechanism(body));
  }
}

Rest RestAudience::For(int peer) const {
  Rest told = head_;
  for (const std::size_t i : due_[static_cast<std::size_t>(peer)]) AddPose(rest_, i, &told);
  return told;
}

void RestAudience::MarkPending(const PeerSet& peers, int mechanism) {
  if (!owed_) {
    owed_.emplace(replica_.table(),
                  [](const PeerSet& before, PeerSet* into) { into->Add(before); });
  }
  (*owed_)[mechanism].Add(peers);
}

bool RestAudience::IsPendingFor(int peer, const RestBlock& at) const {
  if (!owed_) return false;
  const World& world = replica_.world();
  const int count = world.body_count();
  for (int body = at.begin(count); body < at.end(count); ++body) {
    const bool rests = replica_.rest().record(body).committed;
    if (rests && IsPendingFor(peer, world.mechanism(body))) return true;
  }
  return false;
}

std::vector<Rest> RestAudience::Owed(int peer, const std::vector<int>& mechanisms) {
  const World& world = replica_.world();
  std::vector<int> bodies;
  for (const int mechanism : mechanisms) {
    if (!IsPendingFor(peer, mechanism)) continue;
    (*owed_)[mechanism].Remove(peer);
    bool moves = false;  // the copy here may; its authority has not sent so yet
    EachIdOf(world.composition(), mechanism, [&](PartId id) {
      const int body = world.BodyOfId(id);
      const bool told = body >= 0 && replica_.rest().record(body).committed;
      if (!told) return;
      if (replica_.rest().Holds(body)) {
        bodies.push_back(body);
      } else {
        moves = true;
      }
    });
    if (moves) (*owed_)[mechanism].Add(peer);
  }
  std::sort(bodies.begin(), bodies.end());  // the mechanisms may come in any order
  return bodies.empty() ? std::vector<Rest>{} : replica_.rest().Again(bodies);
}

void RestAudience::NoteTold(int peer) {
  if (!owed_) return;
  for (PeerSet& owed : *owed_) owed.Remove(peer);
}

}  // namespace seam
