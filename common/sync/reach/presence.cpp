#include "common/sync/reach/presence.h"

#include <algorithm>
#include <utility>

#include "common/physics/part_places.h"
#include "common/physics/stage.h"
#include "common/scene/forces.h"
#include "common/sync/reach/reach.h"

namespace seam {
namespace {

MovingBox FreeBoxOf(const World& world, int body) {
  MovingBox box = BoxOf(world, body);
  box.acceleration = kDrivenAcceleration;  // that a player or gravity can give it
  return box;
}

/// How far a box can come by itself, m.
float WayOf(const MovingBox& box, float seconds) {
  return box.velocity.norm() * seconds + box.acceleration * seconds * seconds / 2 + kZoneSlack / 2;
}

/// Whether nothing but a body, an input or an edit wakes what sleeps: no anchored part moves or
/// turns a belt, nobody is drawn into a seat, nothing is joined where it lies.
bool OnlyBodiesWake(const World& world) {
  const Scene& scene = world.scene();
  const std::vector<Assembly>& assemblies = world.composition().assemblies;
  const auto driven = [](const Assembly& a) { return a.anchored && a.kinematic >= 0; };
  const auto belt = [&](const Part& part) {
    return !part.gone && part.conveyor->speed != 0 && MechanismOf(world, part.id) < 0;
  };
  return scene.seats.empty() && !ProposesEdits(scene) &&
         std::none_of(assemblies.begin(), assemblies.end(), driven) &&
         std::none_of(scene.parts.begin(), scene.parts.end(), belt);
}

/// By mechanism. What has joints is not, because they would begin without what they pulled with.
std::vector<char> MayIdle(const World& world) {
  std::vector<char> may(world.composition().mechanisms.size(), OnlyBodiesWake(world) ? 1 : 0);
  for (const Joint& joint : world.scene().joints) {
    for (const PartId part : {joint.a, joint.b}) {
      const int m = joint.gone || part < 0 ? -1 : MechanismOf(world, part);
      if (m >= 0) may[static_cast<std::size_t>(m)] = 0;
    }
  }
  return may;
}

}  // namespace

/// Boxes in the order of their left sides, grown by the way that each can make.
class Presence::Sorted {
 public:
  Sorted(std::vector<MovingBox> boxes, float seconds) : boxes_(std::move(boxes)) {
    std::sort(boxes_.begin(), boxes_.end(),
              [](const MovingBox& a, const MovingBox& b) { return a.min.x() < b.min.x(); });
    for (const MovingBox& box : boxes_) {
      way_ = std::max(way_, WayOf(box, seconds));
      widest_ = std::max(widest_, box.max.x() - box.min.x());
      low_ = std::min(low_, box.min.y());
      high_ = std::max(high_, box.max.y());
    }
  }

  bool empty() const { return boxes_.empty(); }
  bool MayMeetAny(const MovingBox& box, float seconds) const {
    return !EachMeeting(box, seconds, [](const MovingBox&) { return false; });
  }
  /// Calls `visit` of each that may meet the box until one says false; false then.
  template <class Visit>
  bool EachMeeting(const MovingBox& box, float seconds, const Visit& visit) const {
    if (boxes_.empty()) return true;
    const float way = way_ + WayOf(box, seconds);
    if (box.max.y() + way < low_ || box.min.y() - way > high_) return true;
    const float from = box.min.x() - way - widest_, to = box.max.x() + way;
    auto at = std::lower_bound(boxes_.begin(), boxes_.end(), from,
                               [](const MovingBox& b, float x) { return b.min.x() < x; });
    for (; at != boxes_.end() && at->min.x() <= to; ++at) {
      if (MayMeet(*at, box, seconds) && !visit(*at)) return false;
    }
    return true;
  }

 private:
  std::vector<MovingBox> boxes_;
  float way_ = 0, widest_ = 0;
  float low_ = 1e30f, high_ = -1e30f;  // m
};

Presence::Presence(const SyncConfig& config, const World& world, const Roles& roles,
                   const BodyMemory& memory)
    : config_(config), world_(world), roles_(roles), memory_(memory) {
  Remap();
}

void Presence::Remap() {
  near_.assign(world_.composition().mechanisms.size(), 1);
  unwatched_.clear();
  idle_.assign(near_.size(), kNotIdle);
  needed_until_.assign(near_.size(), -1);
  may_idle_ = MayIdle(world_);
  rested_.assign(static_cast<std::size_t>(world_.body_count()), {});
  around_.min.setConstant(-1e9f);
  around_.max.setConstant(1e9f);
}

bool Presence::LookIfDue() {
  if (config_.mode != Mode::kBuffer) return false;
  if (world_.tick() % std::max(1, config_.tick_hz / kLooksPerSecond) != 0) return false;
  Look();
  return true;
}

bool Presence::LookIfAsked() {
  if (config_.mode != Mode::kBuffer || !std::exchange(asked_, false)) return false;
  Look();
  return true;
}

bool Presence::Need(int mechanism) {
  const auto m = static_cast<std::size_t>(mechanism);
  needed_until_[m] = world_.tick() + config_.tick_hz;
  return std::exchange(idle_[m], kNotIdle) != kNotIdle;
}

bool Presence::NeedAll() {
  const auto idle = [](std::int32_t epoch) { return epoch != kNotIdle; };
  if (std::none_of(idle_.begin(), idle_.end(), idle)) return false;
  idle_.assign(idle_.size(), kNotIdle);
  return true;
}

/// By mechanism: 1 for what rests and a mover may reach, directly or through others that rest.
std::vector<char> Presence::FindNeeded(const std::vector<MovingBox>& movers,
                                       const std::vector<MovingBox>& resting) const {
  std::vector<char> needed(near_.size(), 0);
  const Sorted moving(movers, kRestSeconds + kRestKeep);
  std::vector<MovingBox> reached;
  for (const MovingBox& box : resting) {
    const auto m = static_cast<std::size_t>(box.group);
    const float seconds = kRestSeconds + (idle_[m] == kNotIdle ? kRestKeep : 0);
    if (!moving.MayMeetAny(box, seconds)) continue;
    needed[m] = 1;
    reached.push_back(box);
  }
  if (reached.empty()) return needed;
  const Sorted others(resting, kNearSeconds);
  while (!reached.empty()) {
    MovingBox box = reached.back();
    reached.pop_back();
    box.acceleration = kDrivenAcceleration;  // a blow passes through it
    others.EachMeeting(box, kNearSeconds, [&](const MovingBox& other) {
      char& is = needed[static_cast<std::size_t>(other.group)];
      if (is == 0) reached.push_back(other);
      is = 1;
      return true;
    });
  }
  return needed;
}

void Presence::FindIdle(const std::vector<char>& needed) {
  if (unwatched_.empty()) return idle_.assign(idle_.size(), kNotIdle);
  std::vector<char> rests = may_idle_;
  for (const int body : memory_.tended()) {
    const auto m = static_cast<std::size_t>(world_.mechanism(body));
    // What rests under its present epoch has been there for a step of it (RestCommit::AfterStep).
    const bool lies = memory_.track(body).at_rest && Unwatched(body) &&
                      (world_.motion(body) == Motion::kDynamic || memory_.track(body).idle);
    if (!lies) rests[m] = 0;
  }
  for (std::size_t m = 0; m < idle_.size(); ++m) {
    const bool own = roles_.RoleOf(static_cast<int>(m)) == kRoleAuthority;
    const bool idle = own && rests[m] != 0 && needed[m] == 0 && needed_until_[m] < world_.tick();
    idle_[m] = idle ? roles_.table().at(static_cast<int>(m)).epoch : kNotIdle;
  }
}

/// Worked out once for as long as it lies there.
const MovingBox& Presence::BoxOfResting(int body) {
  Rested& rested = rested_[static_cast<std::size_t>(body)];
  const std::uint64_t still = world_.still(body);
  if (still == 0 || rested.still != still) rested = {still, BoxOf(world_, body)};
  return rested.box;
}

void Presence::Look() {
  asked_ = false;
  std::vector<MovingBox> simulated, movers, resting;
  std::vector<int> displayed;
  for (const int body : memory_.tended()) {
    if (!roles_.Simulates(body)) {
      displayed.push_back(body);
      const int holder = roles_.table().at(world_.mechanism(body)).authority;
      if (doubtful_.Has(holder)) movers.push_back(FreeBoxOf(world_, body));
    } else if (Unwatched(body)) {
      resting.push_back(BoxOfResting(body));
    } else {
      simulated.push_back(FreeBoxOf(world_, body));
    }
  }
  movers.insert(movers.end(), simulated.begin(), simulated.end());
  const std::vector<char> needed = FindNeeded(movers, resting);
  for (const MovingBox& box : resting) {
    if (needed[static_cast<std::size_t>(box.group)] == 0) continue;
    simulated.push_back(box);
    simulated.back().acceleration = kDrivenAcceleration;
  }
  if (!simulated.empty()) {
    around_ = simulated.front();
    for (const MovingBox& box : simulated) {
      around_.min = around_.min.cwiseMin(box.min);
      around_.max = around_.max.cwiseMax(box.max);
    }
    around_.min.array() -= kAround;
    around_.max.array() += kAround;
  }
  const Sorted there(std::move(simulated), kNearSeconds + kNearKeep);
  std::vector<char> near(near_.size(), 0);
  if (there.empty()) displayed.clear();  // nothing can touch it
  for (const int body : displayed) {
    const auto m = static_cast<std::size_t>(world_.mechanism(body));
    if (near[m] != 0) continue;
    const float seconds = kNearSeconds + (near_[m] != 0 ? kNearKeep : 0);
    if (there.MayMeetAny(FreeBoxOf(world_, body), seconds)) near[m] = 1;
  }
  const std::vector<std::int32_t> idle = idle_;
  FindIdle(needed);
  // What is simulated would be near if it ceased to be.
  for (const int body : world_.present()) {
    if (roles_.Simulates(body)) near[static_cast<std::size_t>(world_.mechanism(body))] = 1;
  }
  changed_.clear();
  for (std::size_t m = 0; m < near.size(); ++m) {
    if (near[m] != near_[m] || idle_[m] != idle[m]) changed_.push_back(static_cast<int>(m));
  }
  near_ = std::move(near);
}

}  // namespace seam
