#include "common/sync/reach/activities.h"

#include <utility>

#include "common/base/check.h"
#include "common/scene/saved/persist_state.h"

namespace seam {

Activities::Activities(const SyncConfig& config, World& world, const Roles& roles,
                       BodyMemory& memory)
    : config_(config),
      world_(world),
      roles_(roles),
      memory_(memory),
      near_(memory.table(), MechanismRule::kFresh, 1),
      may_rest_(memory.table(), MechanismRule::kScratch),
      dormant_(memory.table(), MechanismRule::kFresh, kNotDormant),
      needed_until_(memory.table(), MechanismRule::kFresh, -1),
      rested_(memory.table(), BodyRule::kFresh),
      lies_(memory.table(), MechanismRule::kScratch),
      needed_in_(memory.table(), MechanismRule::kFresh, -1),
      edited_(memory.table(), [this](const BodyRemap&) { Start(); }) {
  Start();
}

/// A displayed body keeps its real mass, so that it is neither a wall to simulated bodies nor feeds
/// energy into them. Mode strict shows the effect of infinite mass, and nothing should lean on
/// interpolated paths of the past.
Activity Activities::Wanted(int body) const {
  const int m = world_.mechanism(body);
  if (roles_.RoleOf(m) != kRoleRemote) {  // dormant until its next hand-over
    const bool dormant = dormant_[m] == roles_.table().at(m).epoch;
    return dormant ? Activity::kDormant : Activity::kSimulated;
  }
  if (!config_.policy->Reckons()) return Activity::kKinematic;
  if (near_[m] != 0) return Activity::kPrescribed;
  return memory_.parked(body) ? Activity::kParked : Activity::kDisplayed;
}

void Activities::Update(int body) {
  const Activity wanted = Wanted(body);
  if (wanted != Activity::kParked) Unpark(body);
  world_.SetActivity(body, wanted);
}

void Activities::Park(int body) {
  SEAM_ASSERT(world_.activity(body) == Activity::kDisplayed);
  world_.SetActivity(body, Activity::kParked);
  memory_.Park(body);
}

bool Activities::Unpark(int body) {
  if (!memory_.parked(body)) return false;
  memory_.Unpark(body);
  world_.SetActivity(body, Activity::kDisplayed);
  return true;
}

void Activities::UnparkAll() {
  if (static_cast<int>(memory_.unparked().size()) == world_.body_count()) return;
  memory_.UnparkAll();
  for (int body = 0; body < world_.body_count(); ++body) {
    if (memory_.parked(body)) world_.SetActivity(body, Activity::kDisplayed);
  }
}

bool Activities::NeedAll() {
  UnparkAll();
  bool any = false;
  for (std::int32_t& epoch : dormant_) any = std::exchange(epoch, kNotDormant) >= 0 || any;
  return any;
}

bool Activities::Need(int mechanism) {
  needed_until_[mechanism] = world_.tick() + config_.tick_hz;
  return std::exchange(dormant_[mechanism], kNotDormant) != kNotDormant;
}

void Activities::Persist(StateArchive& a) {
  a.Section("presence");
  const auto flag = [&](char* is) { a.Int(is, 0, 1); };
  a.Exactly(&near_, flag);
  a.List(&allowed_, near_.size(), flag);
  uncertain_.Persist(a);
  a.Exactly(&needed_until_, [&](std::int64_t* tick) { a.Tick(tick); });
  a.Flag(&asked_);
  a.Real(&fastest_);
  seam::Persist(a, &around_.min, StateArchive::kRealMost);
  seam::Persist(a, &around_.max, StateArchive::kRealMost);
}

}  // namespace seam
