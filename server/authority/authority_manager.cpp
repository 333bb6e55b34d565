#include "server/authority/authority_manager.h"

#include <algorithm>

#include "common/physics/part_places.h"

namespace seam {
namespace {

/// Plans of who simulates what: more often follows faster bodies, and costs more with many.
constexpr int kPlansPerSecond = 10;

void Append(const std::vector<Grants>& more, std::vector<Grants>* all) {
  all->insert(all->end(), more.begin(), more.end());
}

}  // namespace

AuthorityManager::AuthorityManager(const Scene& scene, const SyncConfig& config, Replica& replica)
    : scene_(scene), config_(config), replica_(replica) {
  memory_.resize(static_cast<std::size_t>(table().count()));
  if (config_.mode != Mode::kBuffer) return;
  for (int m = 0; m < table().count(); ++m) {
    AuthorityRecord record;
    record.secondaries.Add(0);
    replica_.authority().Set(m, record);
  }
}

AuthorityView AuthorityManager::Look(const Situation& situation) {
  AuthorityView view;
  view.mode = config_.mode;
  view.tick_hz = config_.tick_hz;
  view.buffer_m = scene_.buffer_m;
  view.together = situation.together;
  for (std::size_t p = 0; p < scene_.players.size(); ++p) {
    const Player& player = scene_.players[p];
    view.players.push_back(
        {situation.peer_of_player[p], player.has_region, player.region_min, player.region_max});
  }
  const World& world = replica_.world();
  for (int m = 0; m < table().count(); ++m) {
    const Mechanism& mechanism = world.composition().mechanisms[static_cast<std::size_t>(m)];
    Memory& memory = memory_[static_cast<std::size_t>(m)];
    MechanismView seen;
    seen.position = world.Read(world.BodyOfId(mechanism.id)).position;
    seen.owner = mechanism.owner;
    seen.now = table().at(m);
    if (seen.now.authority != memory.last_authority) {
      memory.last_authority = seen.now.authority;
      memory.changed_tick = world.tick();
    }
    seen.held_ticks = world.tick() - memory.changed_tick;
    view.mechanisms.push_back(seen);
  }
  // Who may not push a part does not get its authority.
  for (const Part& part : world.scene().parts) {
    if (part.rules->push == kEveryPlayer) continue;
    const int mechanism = MechanismOf(world, part.id);
    if (mechanism < 0) continue;
    view.mechanisms[static_cast<std::size_t>(mechanism)].may_have &= part.rules->push;
  }
  return view;
}

std::vector<Grants> AuthorityManager::Update(std::int64_t now_us, const Situation& situation) {
  if (plan_due_ || replica_.tick() % std::max(1, config_.tick_hz / kPlansPerSecond) == 0) {
    plan_due_ = false;
    plan_ = PlanAuthority(Look(situation));
  }
  std::vector<int> changed;
  std::vector<Grants> grants;  // revocations first
  for (int m = 0; m < table().count(); ++m) {
    Memory& memory = memory_[static_cast<std::size_t>(m)];
    AuthorityRecord record = table().at(m);
    const PlannedAuthority& planned = plan_[static_cast<std::size_t>(m)];
    if (memory.revoking) {
      // One authority at a time: the server takes over only once the holder has confirmed.
      if (!Released(m, situation)) continue;
      memory.revoking = false;
      record = WithoutHolder(record);
      replica_.authority().Set(m, record);
    }
    PeerSet secondaries = planned.secondaries;
    if (config_.mode == Mode::kBuffer) secondaries.Add(0);
    if (record.authority != 0 && planned.authority != record.authority) {
      memory.revoking = true;
      AuthorityTable told = table();
      told.Set(m, WithoutHolder(record));
      Append(told.Export(now_us, replica_.tick(), {m}), &grants);
      continue;
    }
    if (planned.authority == record.authority && secondaries == record.secondaries) continue;
    if (planned.authority != record.authority) record.epoch += 1;
    record.authority = planned.authority;
    record.secondaries = secondaries;
    replica_.authority().Set(m, record);
    changed.push_back(m);
  }
  if (changed.empty()) return grants;
  replica_.RolesChanged();
  Append(table().Export(now_us, replica_.tick(), changed), &grants);
  return grants;
}

bool AuthorityManager::Released(int mechanism, const Situation& situation) const {
  return situation.confirmed.Has(table().at(mechanism).authority);
}

AuthorityRecord AuthorityManager::WithoutHolder(AuthorityRecord record) const {
  // Who lets go goes on simulating until the next grant: its copy is the best there is.
  if (config_.mode == Mode::kBuffer) record.secondaries.Add(record.authority);
  record.authority = 0;
  record.epoch += 1;
  return record;
}

std::vector<Grants> AuthorityManager::TakeBack(std::int64_t now_us, int peer) {
  plan_due_ = true;
  std::vector<int> changed;
  for (int m = 0; m < table().count(); ++m) {
    AuthorityRecord record = table().at(m);
    if (record.authority != peer) continue;
    Memory& memory = memory_[static_cast<std::size_t>(m)];
    record.authority = 0;
    record.epoch += memory.revoking ? 2 : 1;  // a revocation has used up one
    record.secondaries.Remove(peer);
    memory.revoking = false;
    replica_.authority().Set(m, record);
    changed.push_back(m);
  }
  if (changed.empty()) return {};
  replica_.RolesChanged();
  return table().Export(now_us, replica_.tick(), changed);
}

void AuthorityManager::Remap(const std::vector<std::vector<int>>& from) {
  std::vector<Memory> memory;
  for (const std::vector<int>& then : from) {
    memory.push_back(then.empty() ? Memory{} : memory_[static_cast<std::size_t>(then.front())]);
  }
  memory_ = std::move(memory);
  plan_due_ = true;
}

std::vector<Grants> AuthorityManager::Export(std::int64_t now_us) const {
  std::vector<int> all;
  for (int m = 0; m < table().count(); ++m) all.push_back(m);
  return table().Export(now_us, replica_.tick(), all);
}

bool AuthorityManager::Follows(int peer, int body) const {
  return table().at(replica_.world().mechanism(body)).secondaries.Has(peer);
}

bool AuthorityManager::InOneHand(const std::vector<int>& mechanisms) const {
  for (const int m : mechanisms) {
    if (memory_[static_cast<std::size_t>(m)].revoking) return false;
    if (table().at(m).authority != table().at(mechanisms.front()).authority) return false;
  }
  return true;
}

AuthorityManager::Right AuthorityManager::RightToMove(int peer, int body, int epoch) const {
  const AuthorityRecord& record = table().at(replica_.world().mechanism(body));
  if (record.authority == peer) return epoch == record.epoch ? Right::kYes : Right::kStale;
  return epoch < record.epoch ? Right::kStale : Right::kNo;
}

}  // namespace seam
