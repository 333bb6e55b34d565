#include "common/sync/blend/distrusted_rest.h"

#include <algorithm>
#include <cmath>

#include "common/physics/part_places.h"

namespace seam {
namespace {

/// The engine's sleep thresholds, m/s and rad/s, and the factor above them that wakes a committed
/// body.
constexpr float kSleepSpeed = 0.01f, kSleepSpin = 0.035f, kWakeShare = 1.4f;
/// ...if exceeded for this long in a row, s: a corrected copy next to it pushes only for a tick or
/// two. The time doubles with each release, at most kWaitDoublings times: two peers whose copies
/// lie differently would otherwise wake each other forever.
constexpr double kPushedFor = 0.1;
constexpr int kWaitDoublings = 5;
/// An impact, m/s and rad/s: wakes the body at once.
constexpr float kWakeImpactSpeed = 0.5f;
/// Waits before own bodies of an island with several owners are committed, s. kStillFor: they are
/// still for twice the engine's half second. kSlowFor: all hardly move for so long that the peers
/// must disagree; the lowest peer commits. kSlowForAnybody: any peer commits.
constexpr double kStillFor = 1, kSlowFor = 2.5, kSlowForAnybody = 4;
/// A woken copy goes back to rest if its authority has not reported motion for this long, s: more
/// than the round trip of a slow path.
constexpr double kBackAfterRoundTrip = 0.75;

/// By mechanism: true if a player whose axes move it or a belt under it, or who owns it, gives any
/// input in this tick. `inputs`: by player.
std::vector<bool> DrivenIn(const World& world, const Drivers& drivers,
                           const std::vector<InputTrack>& inputs, std::int64_t tick) {
  std::vector<bool> driven(world.composition().mechanisms.size(), false);
  std::vector<PartId> belts;
  for (std::size_t p = 0; p < inputs.size(); ++p) {
    if (inputs[p].At(tick) == Input{}) continue;
    for (const int m : drivers.MovedBy(static_cast<int>(p)))
      driven[static_cast<std::size_t>(m)] = true;
    const std::vector<PartId>& of_player = drivers.BeltsOf(static_cast<int>(p));
    belts.insert(belts.end(), of_player.begin(), of_player.end());
  }
  if (belts.empty()) return driven;
  const auto drives = [&](PartId belt, PartId on_it) {
    const int m = MechanismOf(world, on_it);
    if (m >= 0 && std::find(belts.begin(), belts.end(), belt) != belts.end()) {
      driven[static_cast<std::size_t>(m)] = true;
    }
  };
  for (const PartTouch& touch : world.PartTouches()) {
    drives(touch.a, touch.b);
    drives(touch.b, touch.a);
  }
  return driven;
}

}  // namespace

void DistrustedRest::Prepare() {
  driven_ = DrivenIn(world(), drivers_, inputs_, world().tick() + 1);
}

bool DistrustedRest::IsDisturbed(int body) const {
  const BodyState now = world().Read(body);
  return now.velocity.squaredNorm() > 0 || now.spin != 0 || Driven(body);
}

double DistrustedRest::BackAfter() const { return kBackAfterRoundTrip; }

/// Returns true if a held body that the last step pushed is to be released.
bool DistrustedRest::ExceedsWakeLimit(int body) {
  const BodyState now = world().Read(body);
  const float speed = now.velocity.norm(), spin = std::fabs(now.spin);
  if (speed > kWakeImpactSpeed || spin > kWakeImpactSpeed) return true;
  Disturbance& d = disturbed(body);
  const bool pushed = speed > kWakeShare * kSleepSpeed || spin > kWakeShare * kSleepSpin;
  d.pushed_ticks = pushed ? d.pushed_ticks + 1 : 0;
  if (d.pushed_ticks < Ticks(kPushedFor) << std::min(d.times, kWaitDoublings)) return false;
  ++d.times;
  d.pushed_ticks = 0;
  return true;
}

void DistrustedRest::HoldIsland(const std::vector<int>& island) {
  bool own_awake = false, others_awake = false, driven = false, only_own = true;
  for (const int body : island) {
    const bool struck =
        world().awake(body) && world().Read(body).velocity.norm() > kWakeImpactSpeed;
    driven = driven || struck || Driven(body);
    only_own = only_own && Own(body);
    if (Holds(body) || !world().awake(body)) continue;
    (Own(body) ? own_awake : others_awake) = true;
  }
  for (const int body : island) {
    if (!Holds(body) || !world().awake(body)) continue;
    const bool by_own = Own(body) && (own_awake || (only_own && !others_awake));
    const bool moves = world().activity(body) == Activity::kSimulated;
    if (moves && (by_own || driven || ExceedsWakeLimit(body))) {
      LetGo(body);
    } else {
      Put(body);
    }
  }
}

bool DistrustedRest::MayCommitAwake(const std::vector<int>& island,
                                    const std::vector<int>& own) const {
  const auto each = [](const std::vector<int>& bodies, const auto& holds) {
    return std::all_of(bodies.begin(), bodies.end(), holds);
  };
  if (each(island, [&](int b) { return Own(b); })) return false;
  if (!each(island, [&](int b) { return !Driven(b); })) return false;
  if (each(own, [&](int b) { return watch().still(b) >= Ticks(kStillFor); })) return true;
  const auto slow = [&](double seconds) {
    if (!each(own, [&](int b) { return watch().still(b) > send_every_; })) return false;
    return each(island, [&](int b) { return watch().slow(b) >= Ticks(seconds); });
  };
  const bool lowest = each(island, [&](int b) { return Holds(b) || AuthorityOf(b) >= self_; });
  return slow(kSlowForAnybody) || (lowest && slow(kSlowFor));
}

std::unique_ptr<RestCommit> MakeRestCommit(const SyncConfig& config, World& world,
                                           const Roles& roles, const Drivers& drivers,
                                           BodyMemory& memory, Display& display,
                                           const std::vector<InputTrack>& inputs,
                                           const Reach& reach) {
  if (config.policy->TrustsSleep()) {
    return std::make_unique<RestCommit>(config, world, roles, memory, display, reach);
  }
  return std::make_unique<DistrustedRest>(config, world, roles, drivers, memory, display, inputs,
                                          reach);
}

}  // namespace seam
