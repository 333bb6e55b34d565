#include "common/sync/roles.h"

#include <algorithm>
#include <map>
#include <utility>

#include "common/physics/part_places.h"
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
