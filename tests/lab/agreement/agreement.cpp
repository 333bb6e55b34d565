#include "tests/lab/agreement/agreement.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "tests/support/replica_test_access.h"

namespace seam {

/// Returns the newest tick up to which every peer knows the inputs of every player; nullopt if that
/// is longer ago than the peers' pasts reach.
std::optional<std::int64_t> AgreementWatch::KnownTick() const {
  const std::int64_t now = cluster_.server().tick();
  std::int64_t known = now;
  for (const Replica* peer : peers_) {
    known = std::min(known, peer->tick());
    for (std::size_t p = 0; p < cluster_.scene().players.size(); ++p) {
      const int player = static_cast<int>(p);
      if (player == ReplicaTestAccess::OwnPlayer(*peer)) continue;
      known = std::min(known, peer->inputs(player).newest());
    }
  }
  return known < now - PastTicks() ? std::nullopt : std::optional(known);
}

void AgreementWatch::Compare(int a, int b, std::int64_t tick) {
  const Replica &one = *peers_[static_cast<std::size_t>(a)],
                &other = *peers_[static_cast<std::size_t>(b)];
  for (int body = 0; body < one.world().body_count(); ++body) {
    const BodyState* const here = ReplicaTestAccess::Past(one, body, tick);
    const BodyState* const there = ReplicaTestAccess::Past(other, body, tick);
    const Pair pair{a, b, one.world().id(body)};
    if (here == nullptr || there == nullptr) {
      differ_.erase(pair);
      continue;
    }
    ++compared_;
    const auto [min, max] = one.world().Bounds(body);
    const float turned = std::fabs(WrapAngle(here->angle - there->angle)) * (max - min).norm() / 2;
    if ((here->position - there->position).norm() + turned <= kApart) {
      differ_.erase(pair);
      continue;
    }
    ++differed_;
    const std::int64_t ticks = ++differ_[pair];
    if (ticks <= longest_) continue;
    longest_ = ticks;
    const PartId id = one.world().id(body);
    body_ = one.world().scene().parts[static_cast<std::size_t>(id)].name;
  }
}

void AgreementWatch::Look() {
  if (cluster_.server().tick() == looked_) return;
  looked_ = cluster_.server().tick();
  peers_ = {&cluster_.server().replica()};
  for (int c = 0; c < cluster_.client_count(); ++c) {
    const Client* client = cluster_.client(c);
    if (client == nullptr || !client->running()) return;
    if (client->replica()->revision() != peers_[0]->revision()) return;
    peers_.push_back(client->replica());
  }
  const std::optional<std::int64_t> known = KnownTick();
  if (!known) return;
  const std::int64_t oldest = looked_ - PastTicks();
  if (compared_tick_ < oldest) differ_.clear();  // nobody knows what was between
  for (std::int64_t tick = std::max(compared_tick_ + 1, oldest); tick <= *known; ++tick) {
    for (int a = 0; a < static_cast<int>(peers_.size()); ++a) {
      for (int b = a + 1; b < static_cast<int>(peers_.size()); ++b) Compare(a, b, tick);
    }
    compared_tick_ = tick;
  }
}

std::int64_t AgreementWatch::PastTicks() const {
  return static_cast<std::int64_t>(2) * cluster_.scene().solver.tick_hz;
}

double AgreementWatch::longest_s() const {
  return static_cast<double>(longest_) / cluster_.scene().solver.tick_hz;
}

}  // namespace seam
