#include "server/authority/authority_view.h"

#include <algorithm>

#include "common/physics/part_places.h"
#include "common/scene/part_rules.h"
#include "common/scene/planner/planner_rules.h"
#include "common/sync/lease.h"
#include "common/sync/reach/reach.h"
#include "server/authority/authority_manager.h"

namespace seam {

namespace {

/// A contact shorter than a second / kBouncePart is a bounce and does not end a fall.
constexpr int kBouncePart = 4;

}  // namespace

bool PlansIslands(const Scene& scene) {
  const bool regions = std::any_of(scene.players.begin(), scene.players.end(),
                                   [](const Player& player) { return player.has_region; });
  return scene.planner->given || !regions;
}

std::vector<int> RestrictedParts(const Scene& scene) {
  std::vector<int> restricted;
  for (const Part& part : scene.parts) {
    if (!part.rules->push.everyone()) restricted.push_back(part.id);
  }
  return restricted;
}

void AuthorityManager::Look(const PlannerInputs& situation) {
  AuthorityView& view = view_;
  view.players.clear();
  view.mechanisms.clear();
  view.boxes.clear();
  view.policy = config_.policy;
  view.tick_hz = config_.tick_hz;
  view.buffer_m = scene_.buffer_m;
  view.gravity = scene_.gravity;
  view.follow_bodies = scene_.follow_bodies;
  view.exact = config_.policy->GoesBack(0);
  for (int p = 0; p < static_cast<int>(scene_.players.size()) && view.exact; ++p) {
    view.exact = replica_.drivers().MechanismsOf(p).empty();
  }
  // Of parts that a script adds the server is the first authority: its copies must be as good as
  // those of the peers beside them.
  const bool scripts = config_.policy->GoesBack(0) && !scene_.scripts.empty();
  const bool follows = situation.shown || view.exact || scripts;
  view.server_follow = follows ? scene_.server_follow : 0;
  view.physics_edits = physics_edits_;
  follows_all_ =
      follows_all_ && (physics_edits_ || replica_.world().body_count() <= view.server_follow);
  view.settles = view.exact || (config_.policy->GoesBack(0) && follows_all_);
  view.islands = islands_;
  view.rules = *scene_.planner;
  if (config_.policy->PlansByTouch()) view.rules.acquire = 0;  // to be near is not to touch
  view.together = situation.together;
  LookAtPlayers(situation, &view);
  MayLeaveOut(view) ? SeeAwakeAndNear(view) : SeeAll();
  for (std::vector<int>& mechanisms : view.together) {
    for (int& m : mechanisms) m = PlaceOf(m);
  }
  LookAtMechanisms(situation, &view);
  const bool boxes =
      config_.policy->PlansFollowers() || (islands_ && config_.policy->PlansAuthority());
  if (boxes) LookAtBoxes(&view);
  view.left_out =
      SeesAll() ? 0 : static_cast<std::size_t>(replica_.world().body_count()) - view.boxes.size();
  // A player that may not push a part does not get its authority.
  const World& world = replica_.world();
  for (const int id : restricted_) {
    const int mechanism = MechanismOf(world, static_cast<PartId>(id));
    const int place = mechanism < 0 ? -1 : PlaceOf(mechanism);
    if (place < 0) continue;
    view.mechanisms[static_cast<std::size_t>(place)].may_have &=
        world.scene().parts[static_cast<std::size_t>(id)].rules->push;
  }
}

void AuthorityManager::LookAtPlayers(const PlannerInputs& situation, AuthorityView* view) const {
  view->players.reserve(scene_.players.size());
  for (std::size_t p = 0; p < scene_.players.size(); ++p) {
    const Player& player = scene_.players[p];
    PlayerView seen;
    seen.peer = situation.peer_of_player[p];
    seen.one_way_s = p < situation.one_way_s.size() ? situation.one_way_s[p] : 0;
    seen.has_region = player.has_region && !islands_;
    seen.region_min = player.region_min;
    seen.region_max = player.region_max;
    seen.silent = situation.silent.Has(std::max(0, seen.peer));
    seen.untrusted = situation.untrusted.Has(std::max(0, seen.peer));
    if (view->rules.capacity > 0) seen.capacity = view->rules.capacity;
    view->players.push_back(seen);
  }
}

void AuthorityManager::LookAtCapacity(std::int64_t now_us, const PlannerInputs& situation,
                                      AuthorityView* view) {
  if (situation.load.empty()) return;
  for (std::size_t p = 0; p < view->players.size(); ++p) {
    PlayerView& player = view->players[p];
    // Counted only on demand: most players are never overloaded.
    const auto steps = [&] {
      int bodies = 0;
      for (const MovingBox& box : view->boxes) {
        const AuthorityRecord& now = view->mechanisms[static_cast<std::size_t>(box.group)].now;
        bodies += now.authority == player.peer || now.secondaries.Has(player.peer) ? 1 : 0;
      }
      return bodies;
    };
    const int capacity = capacity_.Look(p, now_us, player.peer, situation.load[p], steps);
    player.capacity = std::min(player.capacity, capacity);
  }
}

void AuthorityManager::LookAtMechanisms(const PlannerInputs& situation, AuthorityView* view) {
  view->mechanisms.reserve(seen_.size());
  for (const int m : seen_) LookAtMechanism(m, situation, view);
  if (!islands_) return;
  for (int p = 0; p < static_cast<int>(view->players.size()); ++p) {
    for (const int m : replica_.drivers().MechanismsOf(p)) {
      const int place = PlaceOf(m);
      if (place < 0) continue;
      MechanismView& seen = view->mechanisms[static_cast<std::size_t>(place)];
      if (seen.driver < 0 && replica_.drivers().Driven(m)) seen.driver = p;
    }
  }
}

void AuthorityManager::LookAtMechanism(int m, const PlannerInputs& situation, AuthorityView* view) {
  const World& world = replica_.world();
  const Mechanism& mechanism = world.composition().mechanisms[static_cast<std::size_t>(m)];
  Memory& memory = memory_[m];
  MechanismView seen;
  const int root = world.BodyOfId(mechanism.id);
  const BodyState state = world.Read(root);
  seen.position = state.position;
  seen.owner = seen.driver = mechanism.owner;
  seen.moves = world.awake(root) && state.velocity.norm() > kStandInSpeed;
  seen.asleep = !world.awake(root);
  if (situation.falls && situation.falls(mechanism.id)) memory.fell_tick = world.tick();
  seen.falls = world.tick() - memory.fell_tick <= config_.tick_hz / kBouncePart;
  seen.now = table().at(m);
  if (seen.now.authority != memory.last_authority) {
    memory.last_authority = seen.now.authority;
    memory.changed_tick = world.tick();
  }
  seen.held_ticks = world.tick() - memory.changed_tick;
  if (seen.now.authority == 0) memory.contested = 0;
  seen.contested = memory.contested;
  seen.decided =
      static_cast<std::size_t>(m) < plan_.size() && plan_[static_cast<std::size_t>(m)].decided;
  view->mechanisms.push_back(seen);
}

std::vector<char> AuthorityManager::MayBeDormant(const AuthorityView& view) const {
  std::vector<char> allowed(memory_.values().size(), 0);
  if (!view.islands || view.policy->InputsOnly()) return allowed;
  if (view.left_out > 0) {
    std::fill(allowed.begin(), allowed.end(), char{1});  // all left-out mechanisms sleep
    for (const int id : restricted_) {
      const int m = MechanismOf(replica_.world(), static_cast<PartId>(id));
      if (m >= 0) allowed[static_cast<std::size_t>(m)] = 0;
    }
  }
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const auto m = static_cast<std::size_t>(seen_[i]);
    const MechanismView& seen = view.mechanisms[i];
    const bool free = seen.asleep && seen.may_have.everyone();
    allowed[m] = free && plan_[m].authority == 0 && seen.now.authority == 0 ? 1 : 0;
  }
  return allowed;
}

PeerSet AuthorityManager::UncertainPeers(const AuthorityView& view) const {
  PeerSet uncertain;
  for (const PlayerView& p : view.players) {
    if (p.limited() || (p.silent && p.peer > 0)) uncertain.Add(p.peer);
  }
  return uncertain;
}

bool AuthorityManager::FeelsAnchored(int peer) const {
  if (config_.policy->ServerFeelsAll()) return false;
  for (int m = 0; m < table().count(); ++m) {
    if (Has(peer, m)) return true;
  }
  return false;
}

}  // namespace seam
