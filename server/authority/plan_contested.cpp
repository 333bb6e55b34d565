#include "server/authority/plan_contested.h"

#include <algorithm>

#include "server/authority/contact_groups.h"

namespace seam {
namespace {

/// Awake members of a contact group.
struct Crowd {
  int members = 0, decided = 0;
  float contested = 0;
  int owner = -1;  // of the first member
  bool several = false;

  void Add(const MechanismView& mechanism) {
    const int authority = mechanism.now.authority;
    several = several || (members > 0 && authority != owner);
    if (members++ == 0) owner = authority;
    decided += mechanism.decided ? 1 : 0;
    contested += mechanism.contested;
  }
  bool Contested() const { return several && contested >= kContestedSum; }
  /// True if most members are taken already: newcomers are taken with them.
  bool Decided() const { return members > 1 && 2 * decided >= members; }
};

}  // namespace

void DecideContested(const PlanGround& ground, AuthorityPlan* plan) {
  const AuthorityView& view = ground.view();
  const bool any = std::any_of(
      view.mechanisms.begin(), view.mechanisms.end(),
      [](const MechanismView& mechanism) { return mechanism.contested > 0 || mechanism.decided; });
  if (!any) return;
  const std::vector<int> groups = FindContactGroups(ground, *plan, false).soon;
  std::vector<Crowd> crowds(plan->size());
  for (std::size_t m = 0; m < plan->size(); ++m) {
    const MechanismView& mechanism = view.mechanisms[m];
    if (!mechanism.asleep) crowds[static_cast<std::size_t>(groups[m])].Add(mechanism);
  }
  for (std::size_t m = 0; m < plan->size(); ++m) {
    const Crowd& crowd = crowds[static_cast<std::size_t>(groups[m])];
    const MechanismView& mechanism = view.mechanisms[m];
    if (mechanism.asleep || (!crowd.Contested() && !crowd.Decided())) continue;
    // Its driver steps it on and feels no delay.
    if ((*plan)[m].authority > 0) (*plan)[m].secondaries.Add((*plan)[m].authority);
    (*plan)[m].authority = 0;
    (*plan)[m].decided = true;
  }
}

}  // namespace seam
