#include "common/sync/roles.h"

#include <algorithm>
#include <map>
#include <utility>

#include "common/physics/part_places.h"
#include "common/scene/character.h"
#include "common/scene/part_rules.h"
#include "common/sync/reach/driven.h"

namespace seam {
namespace {

/// Every peer simulates a new mechanism, such as pieces freed from bricks, until its grant arrives:
/// a displayed body flies through walls, and its holder would begin behind them.
AuthorityRecord FreshRecord(const SyncConfig& config, int self) {
  AuthorityRecord fresh;
  if (!config.policy->PlansFollowers()) return fresh;
  fresh.secondaries.Add(0);
  fresh.secondaries.Add(self);
  return fresh;
}

}  // namespace

Roles::Roles(const SyncConfig& config, int self, int own_player, const World& world,
             const BodyTable& bodies)
    : config_(config),
      self_(self),
      own_player_(own_player),
      world_(world),
      table_(world.composition(), bodies, FreshRecord(config, self)) {}

std::int8_t Roles::RoleOf(int mechanism) const {
  if (IsAuthority(mechanism)) return kRoleAuthority;
  return config_.policy->Follows(*this, mechanism) ? kRoleSecondary : kRoleRemote;
}

const std::vector<bool>& Roles::Own() const {
  const int revision = world_.topology().revision();
  if (own_of_revision_ != revision) {
    own_of_revision_ = revision;
    own_ = DrivenMechanisms(world_, own_player_, false);
  }
  return own_;
}

void Roles::LookAtScene() const {
  const int revision = world_.topology().revision();
  if (looked_at_revision_ == revision) return;
  looked_at_revision_ = revision;
  has_rules_ = NeedsRules(world_.scene());
  characters_.assign(static_cast<std::size_t>(table_.count()), false);
  for (const Character& character : world_.scene().characters) {
    for (const PartId part : character.parts) {
      const int m = part < 0 ? -1 : MechanismOf(world_, part);
      if (m >= 0) characters_[static_cast<std::size_t>(m)] = true;
    }
  }
}

bool Roles::CopiesAgree(int mechanism) const {
  if (!config_.policy->CopiesAgree()) return false;
  LookAtScene();
  return !characters_[static_cast<std::size_t>(mechanism)];
}

bool Roles::RefreshesOnly(int mechanism) const {
  const Scene& scene = world_.scene();
  const int bodies = world_.body_count();
  if (bodies > scene.follow_bodies || !CopiesAgree(mechanism)) return false;
  const AuthorityRecord& record = table_.at(mechanism);
  // In a room of server_follow bodies the server follows all if anybody sees its copies.
  const bool followed = record.secondaries.Has(0) || bodies <= scene.server_follow;
  return record.authority > 0 && followed && !has_rules_;
}

bool Roles::Shares() const {
  if (!config_.policy->PlansFollowers()) return true;
  const std::vector<int>& present = world_.present();
  return std::any_of(present.begin(), present.end(), [this](int body) {
    if (!world_.awake(body)) return false;
    const AuthorityRecord& record = table_.at(world_.mechanism(body));
    const bool has = record.authority == self_;
    return has ? !record.secondaries.empty() : record.secondaries.Has(self_);
  });
}

bool Roles::Proposes(const Edit& edit) const {
  for (const PartId part : world_.topology().PartsOf(edit)) {
    const int m = MechanismOf(world_, part);
    if (m >= 0) return Finds(m);
  }
  // An anchored assembly has no authority: it is strained by bodies of any peer.
  return self_ == 0 || !config_.policy->ServerFeelsAll();
}

bool Roles::Tells(const PartTouch& touch) const {
  const int a = MechanismOf(world_, touch.a);
  const int m = a >= 0 ? a : MechanismOf(world_, touch.b);
  return m >= 0 && Finds(m);
}

bool Roles::Finds(int mechanism) const {
  const bool server =
      config_.policy->SendsCompleteTicks() && table_.at(mechanism).secondaries.Has(0);
  return server ? self_ == 0 : IsAuthority(mechanism);
}

GrantsApplied Roles::Apply(const Grants& grants) {
  std::map<int, std::pair<std::int8_t, bool>> before;  // role, and true if it had authority
  for (const PartId id : grants.mechanism) {
    const int m = table_.IndexOf(id);
    if (m >= 0) before[m] = {RoleOf(m), IsAuthority(m)};
  }
  GrantsApplied applied;
  for (const int m : table_.Apply(grants)) {
    const auto& [role, had] = before[m];
    if (role != RoleOf(m)) applied.roles.push_back(m);
    if (had && !IsAuthority(m)) applied.let_go.push_back(m);
  }
  return applied;
}

void Roles::ReleaseAll() {
  for (int m = 0; m < table_.count(); ++m) {
    AuthorityRecord h = table_.at(m);
    if (h.authority != self_) continue;
    h.authority = 0;
    table_.Set(m, h);
  }
}

}  // namespace seam
