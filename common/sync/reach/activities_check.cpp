/// Activities: the check of the bodies that have to be present.

#include <algorithm>
#include <utility>

#include "common/physics/part_places.h"
#include "common/physics/stage.h"
#include "common/scene/forces.h"
#include "common/scene/mechanism_ids.h"
#include "common/sync/reach/activities.h"
#include "common/sync/reach/reach.h"

namespace seam {
namespace {

MovingBox FreeBoxOf(const World& world, int body) {
  MovingBox box = BoxOf(world, body);
  box.acceleration = kDrivenAcceleration;  // the most that a player or gravity can cause
  return box;
}

/// Returns how far a box can come by itself, m.
float WayOf(const MovingBox& box, float seconds) {
  return box.velocity.norm() * seconds + box.acceleration * seconds * seconds / 2 + kZoneSlack / 2;
}

bool SameBox(const MovingBox& a, const MovingBox& b) {
  return a.min == b.min && a.max == b.max && a.velocity == b.velocity && a.group == b.group;
}

/// True if only a body, an input or an edit can wake a sleeping body: no anchored part moves or
/// turns a belt, no seat draws a player in, and no stage proposes edits.
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

/// By mechanism: true if it may be dormant. Jointed mechanisms may not: they would return without
/// their joint impulses.
std::vector<char> MayBeDormant(const World& world) {
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

/// Boxes sorted by their left sides, for queries that add the distance each can travel.
class Activities::Sorted {
 public:
  /// Sorts the boxes, which must outlive this.
  Sorted(std::vector<MovingBox>* boxes, float seconds) : boxes_(*boxes) {
    std::sort(boxes->begin(), boxes->end(),
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
    if (boxes_.empty()) return false;
    const float way = way_ + WayOf(box, seconds);
    if (box.max.y() + way < low_ || box.min.y() - way > high_) return false;
    const float from = box.min.x() - way - widest_, to = box.max.x() + way;
    auto at = std::lower_bound(boxes_.begin(), boxes_.end(), from,
                               [](const MovingBox& b, float x) { return b.min.x() < x; });
    for (; at != boxes_.end() && at->min.x() <= to; ++at) {
      if (MayMeet(*at, box, seconds)) return true;
    }
    return false;
  }

 private:
  const std::vector<MovingBox>& boxes_;
  float way_ = 0, widest_ = 0;
  float low_ = 1e30f, high_ = -1e30f;  // m
};

void Activities::Start() {
  allowed_.clear();
  may_rest_.values() = MayBeDormant(world_);
  resting_.Clear(rested_.values().size());
  rests_.clear();
  fastest_ = 0;
  around_.min.setConstant(-1e9f);
  around_.max.setConstant(1e9f);
}

bool Activities::CheckIfDue() {
  if (!config_.policy->Reckons()) return false;
  // Peers check in different ticks, so that a machine with many peers has even load.
  const int every = std::max(1, config_.tick_hz / kLooksPerSecond);
  if ((world_.tick() + roles_.self()) % every != 0) return false;
  Look();
  return true;
}

bool Activities::CheckIfRequested() {
  if (!config_.policy->Reckons() || !std::exchange(asked_, false)) return false;
  Look();
  return true;
}

/// Finds bodies that may have changed since the last check; other resting bodies lie as before.
void Activities::FindStirred() {
  stirred_.clear();
  const bool known = world_.ChangedSince(change_, &stirred_);
  change_ = world_.last_change();
  for (const int body : stirred_) rested_[body].changed_in = looks_;
  if (known) return;
  for (Rested& rested : rested_) rested.changed_in = looks_;
}

void Activities::Rest(int body, std::uint64_t still) {
  Rested& rested = rested_[body];
  rested.seen_in = looks_;
  const bool kept = resting_.Has(body);
  if (kept && still != 0 && rested.still == still) return;
  rested.still = still;
  const MovingBox box = BoxOf(world_, body);
  if (kept && SameBox(resting_.at(body), box)) return;
  if (!kept) rests_.push_back(body);
  resting_.Put(body, box);
  fastest_ = std::max(fastest_, box.velocity.norm());
}

void Activities::ForgetOthers() {
  const auto rests = [&](int body) {
    if (rested_[body].seen_in == looks_) return true;
    resting_.Take(body);
    return false;
  };
  rests_.erase(std::stable_partition(rests_.begin(), rests_.end(), rests), rests_.end());
  resting_.Tidy();
}

/// Marks all resting bodies of a mechanism as needed.
void Activities::Reach(int mechanism) {
  needed_in_[mechanism] = looks_;
  EachIdOf(world_.composition(), mechanism, [&](PartId id) {
    const int body = world_.BodyOfId(id);
    if (body >= 0 && resting_.Has(body)) needed_.push_back(body);
  });
}

/// Finds resting bodies that a mover may reach, directly or through other resting bodies.
void Activities::FindNeeded() {
  needed_.clear();
  const auto each = [&](const MovingBox& box, float most, const auto& seconds_of) {
    const float way = WayOf(box, most) + fastest_ * most + kZoneSlack;
    resting_.EachWithin(box.min.array() - way, box.max.array() + way,
                        [&](int, const MovingBox& other) {
                          if (Needed(other.group)) return;
                          if (MayMeet(other, box, seconds_of(other.group))) Reach(other.group);
                        });
  };
  for (const MovingBox& box : movers_) {
    each(box, kRestSeconds + kRestKeep,
         [&](int m) { return kRestSeconds + (dormant_[m] == kNotDormant ? kRestKeep : 0); });
  }
  for (std::size_t i = 0; i < needed_.size(); ++i) {
    MovingBox box = resting_.at(needed_[i]);
    box.acceleration = kDrivenAcceleration;  // an impact passes through it
    each(box, kNearSeconds, [](int) { return kNearSeconds; });
  }
}

/// Finds mechanisms of this peer that lie at rest where no mover may reach them.
void Activities::FindDormant() {
  for (int m = 0; m < dormant_.size(); ++m) {
    const bool dormant = Allowed(m) && lies_[m] != 0 && roles_.RoleOf(m) == kRoleAuthority &&
                         !Needed(m) && needed_until_[m] < world_.tick();
    const std::int32_t epoch = dormant ? roles_.table().at(m).epoch : kNotDormant;
    if (std::exchange(dormant_[m], epoch) != epoch) changed_.push_back(m);
  }
}

void Activities::SortOut() {
  simulated_.clear();
  movers_.clear();
  displayed_.clear();
  lies_.values() = may_rest_.values();
  for (const int body : memory_.unparked()) {
    const int m = world_.mechanism(body);
    if (roles_.RoleOf(m) == kRoleRemote) {
      displayed_.push_back(body);
      if (uncertain_.Has(roles_.table().at(m).authority)) {
        movers_.push_back(FreeBoxOf(world_, body));
      }
      continue;
    }
    const Rested& rested = rested_[body];
    const bool as_before =
        rested.still != 0 && rested.seen_in == looks_ - 1 && rested.changed_in != looks_;
    const bool allowed = Allowed(m);
    const std::uint64_t still = as_before ? rested.still : allowed ? world_.still(body) : 0;
    const bool rests = allowed && (still != 0 || !world_.awake(body));
    if (rests) {
      Rest(body, still);
    } else {
      simulated_.push_back(FreeBoxOf(world_, body));
    }
    // A body at rest under its present epoch was present for at least one step
    // (RestCommit::AfterStep).
    if (!rests || !memory_.track(body).at_rest) lies_[m] = 0;
  }
  movers_.insert(movers_.end(), simulated_.begin(), simulated_.end());
}

/// Finds displayed mechanisms that may meet a simulated one.
void Activities::FindNear() {
  std::fill(near_.begin(), near_.end(), char{0});
  const Sorted there(&simulated_, kNearSeconds + kNearKeep);
  for (const int body : displayed_) {
    if (there.empty()) break;  // no simulated body could touch them
    char& near = near_[world_.mechanism(body)];
    if (near != 0) continue;
    const bool was_near = world_.activity(body) == Activity::kPrescribed;
    const float seconds = kNearSeconds + (was_near ? kNearKeep : 0);
    if (there.MayMeetAny(FreeBoxOf(world_, body), seconds)) near = 1;
  }
  for (const int body : displayed_) {
    if (Wanted(body) != world_.activity(body)) changed_.push_back(world_.mechanism(body));
  }
}

void Activities::Look() {
  asked_ = false;
  ++looks_;
  changed_.clear();
  FindStirred();
  SortOut();
  ForgetOthers();
  FindNeeded();
  for (const int body : needed_) {
    simulated_.push_back(resting_.at(body));
    simulated_.back().acceleration = kDrivenAcceleration;
  }
  if (!simulated_.empty()) {
    around_ = simulated_.front();
    for (const MovingBox& box : simulated_) {
      around_.min = around_.min.cwiseMin(box.min);
      around_.max = around_.max.cwiseMax(box.max);
    }
    around_.min.array() -= kAround;
    around_.max.array() += kAround;
  }
  FindNear();
  FindDormant();
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  // A simulated mechanism would be near if it became displayed.
  for (const int body : world_.present()) {
    if (roles_.Simulates(body)) near_[world_.mechanism(body)] = 1;
  }
}

}  // namespace seam
