#include "server/authority/planner.h"

#include <algorithm>

namespace seam {
namespace {

Vec2 RootPosition(const World& world, int mechanism) {
  const Composition& c = world.composition();
  const PartId id = c.mechanisms[static_cast<std::size_t>(mechanism)].id;
  return world.Read(world.BodyOfId(id)).position;
}

float DistanceToBox(const Vec2& p, const Vec2& min, const Vec2& max) {
  const Vec2 nearest = p.cwiseMax(min).cwiseMin(max);
  return (p - nearest).norm();
}

}  // namespace

Planner::Planner(const Scene& scene, const SyncConfig& config) : scene_(scene), config_(config) {}

int Planner::WantedPlayer(const World& world, int mechanism, int current_player) const {
  const Vec2 at = RootPosition(world, mechanism);
  if (current_player >= 0 && scene_.players[static_cast<std::size_t>(current_player)].has_region) {
    const Player& p = scene_.players[static_cast<std::size_t>(current_player)];
    if (DistanceToBox(at, p.region_min, p.region_max) <= kHysteresis) return current_player;
  }
  for (std::size_t i = 0; i < scene_.players.size(); ++i) {
    const Player& p = scene_.players[i];
    if (p.has_region && DistanceToBox(at, p.region_min, p.region_max) <= 0) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

void Planner::Remap(const std::vector<std::vector<int>>& from) {
  if (changed_tick_.empty()) return;
  std::vector<std::int64_t> changed;
  std::vector<int> last;
  for (const std::vector<int>& then : from) {
    const auto first = then.empty() ? 0 : static_cast<std::size_t>(then.front());
    changed.push_back(then.empty() ? -1000000 : changed_tick_[first]);
    last.push_back(then.empty() ? 0 : last_authority_[first]);
  }
  changed_tick_ = changed;
  last_authority_ = last;
}

std::vector<PlannedAuthority> Planner::Plan(const World& world, const AuthorityTable& table,
                                            const std::vector<int>& peer_of_player) {
  const auto count = static_cast<std::size_t>(table.count());
  std::vector<PlannedAuthority> plan(count);
  if (config_.mode == Mode::kOracle || config_.mode == Mode::kCentral) return plan;
  if (changed_tick_.empty()) {
    changed_tick_.assign(count, -1000000);
    last_authority_.assign(count, 0);
  }
  std::vector<Vec2> positions;
  for (int m = 0; m < table.count(); ++m) positions.push_back(RootPosition(world, m));

  for (std::size_t m = 0; m < count; ++m) {
    const int current = table.at(static_cast<int>(m)).authority;
    if (current != last_authority_[m]) {
      last_authority_[m] = current;
      changed_tick_[m] = world.tick();
    }
    int current_player = -1;
    for (std::size_t p = 0; p < peer_of_player.size(); ++p) {
      if (current > 0 && peer_of_player[p] == current) current_player = static_cast<int>(p);
    }
    int player = world.composition().mechanisms[m].owner;
    if (player < 0 || peer_of_player[static_cast<std::size_t>(player)] < 0) {
      player = WantedPlayer(world, static_cast<int>(m), current_player);
    }
    int wanted = player >= 0 ? peer_of_player[static_cast<std::size_t>(player)] : -1;
    if (wanted < 0) wanted = 0;
    const bool dwells =
        current_player >= 0 &&
        world.tick() - changed_tick_[m] < static_cast<std::int64_t>(kDwell * config_.tick_hz);
    plan[m].authority = dwells ? current : wanted;
  }
  if (config_.mode != Mode::kBuffer) return plan;

  for (std::size_t p = 0; p < peer_of_player.size(); ++p) {
    const int peer = peer_of_player[p];
    if (peer <= 0) continue;
    const Player& player = scene_.players[p];
    for (std::size_t m = 0; m < count; ++m) {
      if (plan[m].authority == peer) continue;
      const bool follows = table.at(static_cast<int>(m)).secondaries.Has(peer);
      const float reach = scene_.buffer_m + (follows ? kHysteresis : 0.0f);
      bool near = player.has_region &&
                  DistanceToBox(positions[m], player.region_min, player.region_max) <= reach;
      for (std::size_t o = 0; o < count && !near; ++o) {
        near = plan[o].authority == peer && (positions[o] - positions[m]).norm() <= reach;
      }
      if (near) plan[m].secondaries.Add(peer);
    }
  }
  return plan;
}

}  // namespace seam
