#include "common/sync/display.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/base/geometry.h"
#include "common/sync/state_arithmetic.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// A larger turn within a tick is taken for a fast wheel's, which the eye cannot follow.
constexpr float kTurnSeen = 0.5f;

/// Time after a correction in which the engine may still be closing torn joints, ticks.
constexpr int kCorrectedTicks = 10;

/// Interval at which a parked body is checked, ticks. Its newest state bounds its possible places,
/// so only this peer's own movement counts.
constexpr int kParkedEvery = 30;

/// Returns a box that overlaps no other.
MovingBox Nowhere() {
  MovingBox box;
  box.min.setConstant(1e30f);
  box.max.setConstant(-1e30f);
  return box;
}

bool Overlap(const MovingBox& a, const MovingBox& b) {
  return a.min.x() <= b.max.x() && b.min.x() <= a.max.x() && a.min.y() <= b.max.y() &&
         b.min.y() <= a.max.y();
}

/// Fills `driven` (ascending) with the bodies to move to the tick `next`: present bodies that are
/// not simulated, others at their turn, and the bodies in `back`.
void FindDriven(const World& world, const BodyMemory& memory, const JointCloser& joints,
                const std::vector<int>& back, std::int64_t next, std::vector<int>* driven) {
  driven->clear();
  for (const int body : world.present()) {
    if (world.activity(body) != Activity::kSimulated) driven->push_back(body);
  }
  const auto only_shown = [&](int b) { return world.activity(b) == Activity::kDisplayed; };
  const auto mechanisms = static_cast<int>(world.composition().mechanisms.size());
  const auto turn = static_cast<int>(next % kShownEvery);
  // If any body is parked, iterates over the others; else over the mechanisms.
  const std::vector<int>& unparked = memory.unparked();
  if (static_cast<int>(unparked.size()) < world.body_count()) {
    std::copy_if(unparked.begin(), unparked.end(), std::back_inserter(*driven), [&](int body) {
      return only_shown(body) && (turn + world.mechanism(body)) % kShownEvery == 0;
    });
  } else {
    for (int m = (kShownEvery - turn) % kShownEvery; m < mechanisms; m += kShownEvery) {
      const std::vector<int>& bodies = joints.bodies(m);
      std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(*driven), only_shown);
    }
  }
  std::copy_if(back.begin(), back.end(), std::back_inserter(*driven), only_shown);
  std::sort(driven->begin(), driven->end());
  driven->erase(std::unique(driven->begin(), driven->end()), driven->end());
}

/// True if a body that is not present sleeps at its last committed pose: RestCommit would put it
/// back there before the step, whatever its path.
bool Lies(const World& world, const BodyMemory& memory, int body) {
  const Snapshots& heard = memory.snapshots();
  if (!memory.track(body).at_rest || world.awake(body) || !heard.has(body)) return false;
  const BodyState &told = heard.newest(body), now = world.Read(body);
  return told.position == now.position && told.angle == now.angle &&
         told.velocity == now.velocity && told.spin == now.spin && now.spin == 0 &&
         now.velocity == Vec2(0, 0);
}

}  // namespace

Display::Display(const SyncConfig& config, World& world, BodyMemory& memory, Activities& activities)
    : config_(config),
      world_(world),
      memory_(memory),
      activities_(activities),
      snapshots_(memory.snapshots()),
      smoother_(memory.table(), config.smooth_rate),
      joints_(world),
      reckoner_(world, memory.snapshots(), joints_),
      delayed_(world, memory.snapshots(), config.send_every()),
      seats_(memory.table()),
      ages_(config),
      shown_(memory.table(),
             [](int, const BodyOrigin& origin, Shown* before) {
               if (before == nullptr) return Shown{};
               Shown shown = *before;
               if (!origin.same) shown.then = Carried(origin, before->then);
               return shown;
             }),
      corrected_until_(memory.table(), MechanismRule::kFresh, 0),
      far_(memory.table(), MechanismRule::kFresh, Nowhere()),
      poses_(memory.table(), BodyRule::kScratch),
      edited_(memory.table(), [this](const BodyRemap& change) { Edited(change); }) {}

/// Returns the visible part of a jump. The angle of a wheel that spins, or did before, cannot be
/// seen, and gliding over its jump would show a wrong angle for longer.
BodyState Display::Visible(int body, BodyState jump) const {
  const BodyState now = world_.Read(body);
  if (std::max(std::fabs(now.spin), std::fabs(now.spin - jump.spin)) < kSpinSeen) return jump;
  // The glide is that of the centre of mass.
  const Vec2 centre = world_.mass_point(body).centre;
  jump.position += Turned(centre, now.angle) - Turned(centre, now.angle - jump.angle);
  jump.angle = jump.spin = 0;
  return jump;
}

void Display::Moved(int body, const BodyState& by) {
  if (!Negligible(by)) on_corrected_(body, by);
  if (!shown_[body].past) smoother_.Moved(body, Visible(body, by));
  corrected_until_[world_.mechanism(body)] = glides_ + kCorrectedTicks;
}

void Display::Edited(const BodyRemap& change) {
  joints_.Rebuild();
  if (config_.policy->IsOracle()) return;  // the oracle hides nothing
  for (std::size_t body = 0; body < change.jumps.size(); ++body) {
    Shown& shown = shown_[static_cast<int>(body)];
    if (shown.past) {
      shown.jump =
          shown.edited < 0 ? change.jumps[body] : PlusScaled(shown.jump, change.jumps[body], 1);
      shown.edited = world_.tick() + 1;
    } else {
      smoother_.Moved(static_cast<int>(body), change.jumps[body]);
    }
  }
}

void Display::Reset(int body) {
  smoother_.Reset(body);
  shown_[body] = Shown{};
  shown_[body].since = world_.tick() + 1;
}

void Display::Glide(const Roles& roles, const MissingInputs& missing) {
  ++glides_;
  if (config_.smooth_rate <= 0) return;
  seats_.Look(world_);
  ShowOthers(roles, missing);
  for (const int first : memory_.unparked()) {
    const int m = world_.mechanism(first);
    const std::vector<int>& bodies = joints_.bodies(m);
    if (bodies.front() != first) continue;
    if (bodies.size() == 1) {
      smoother_.Advance(first, world_.dt(), Base(first).velocity.norm());
    } else {
      smoother_.AdvanceTogether(
          world_, bodies, [this](int body) { return Base(body); }, seats_.IsGentle(m));
    }
  }
  KeepClosed(roles);
}

/// Adds the moves made by closing joints to the offsets, so that they return too. If torn poses
/// were closed anew in every tick, the view would jump whenever the simulated state does.
void Display::KeepClosed(const Roles& roles) {
  const BodyColumn<BodyState>& poses = ShownPoses(roles, config_.shows_far);
  for (const int m : seats_.players()) {
    const bool simulated = roles.RoleOf(m) != kRoleRemote;
    if (!simulated && !config_.shows_far) continue;
    const std::vector<int>& bodies = joints_.bodies(m);
    if (seats_.IsGentle(m) && seats_.HoldBack(world_, bodies, &poses_.values())) {
      joints_.Close(m, simulated, &poses_.values());
    }
    seats_.Shown(world_, bodies, poses_.values());
  }
  EachShown(roles, config_.shows_far, [&](int body) {
    if (!joints_.jointed(world_.mechanism(body))) return;
    smoother_.Set(body, Minus(poses[body], Base(body)));
  });
}

/// Returns a box around all places where a mechanism can be displayed, given its newest states.
MovingBox Display::FarBox(int mechanism) const {
  MovingBox box = Nowhere();
  for (const int body : joints_.bodies(mechanism)) {
    if (!snapshots_.has(body)) {
      box.min.setConstant(-1e30f);
      box.max.setConstant(1e30f);
      return box;
    }
    const BodyState& heard = snapshots_.newest(body);
    Vec2 at = heard.position + kReckonShownMax * heard.velocity;
    box.min = box.min.cwiseMin(heard.position.cwiseMin(at));
    box.max = box.max.cwiseMax(heard.position.cwiseMax(at));
    if (!snapshots_.falls(body)) continue;
    at += (kReckonShownMax * kReckonShownMax / 2) * world_.scene().gravity;
    box.min = box.min.cwiseMin(at);
    box.max = box.max.cwiseMax(at);
  }
  return box;
}

void Display::CheckParkedMechanism(int mechanism, const MovingBox& seen) {
  MovingBox& far = far_[mechanism];
  if (!Overlap(far, seen)) return;
  far = Nowhere();
  for (const int body : joints_.bodies(mechanism)) {
    if (!activities_.Unpark(body)) continue;
    Reset(body);
    back_.push_back(body);
  }
}

/// Checks a share of the parked mechanisms per tick, and those that were heard of.
void Display::CheckParked(std::int64_t next, const MovingBox& seen) {
  back_.clear();
  if (config_.shows_far) return;
  const auto count = static_cast<std::int64_t>(far_.size()), part = next % kParkedEvery;
  for (auto m = part * count / kParkedEvery; m < (part + 1) * count / kParkedEvery; ++m) {
    CheckParkedMechanism(static_cast<int>(m), seen);
  }
  for (const int body : memory_.news()) {
    if (!memory_.parked(body)) continue;
    const int m = world_.mechanism(body);
    far_[m] = FarBox(m);
    CheckParkedMechanism(m, seen);
  }
  std::sort(back_.begin(), back_.end());
}

void Display::Leave(int body) {
  const int m = world_.mechanism(body);
  BodyState still = world_.Read(body);
  still.velocity.setZero();
  still.spin = 0;
  world_.Write(body, still, false);
  activities_.Park(body);
  shown_[body] = Shown{};
  far_[m] = FarBox(m);
}

void Display::Drive(std::int64_t next, const MovingBox& seen) {
  const bool reckons = config_.policy->Reckons();
  if (reckons) {
    reckoner_.Begin(next);
  } else {
    delayed_.Begin(next);
  }
  CheckParked(next, seen);
  leaving_.clear();
  FindDriven(world_, memory_, joints_, back_, next, &driven_);
  for (const int body : driven_) {
    const bool only_shown = world_.activity(body) == Activity::kDisplayed;
    if (only_shown && !config_.shows_far && !Overlap(FarBox(world_.mechanism(body)), seen)) {
      leaving_.push_back(body);
      continue;
    }
    if (only_shown && Lies(world_, memory_, body)) continue;
    BodyState state = world_.Read(body);
    if (!snapshots_.has(body)) {
      state.velocity.setZero();
      state.spin = 0;
    } else if (reckons) {
      state = Along(body, reckoner_.Here(body), reckoner_.Speed(body), state);
    } else {
      state = Along(body, delayed_.Here(body), delayed_.Speed(body), state);
    }
    const bool moves = state.velocity.squaredNorm() > 0 || state.spin != 0;
    world_.Write(body, state, moves);
    if (only_shown) memory_.MarkUpdated(body);
  }
  for (const int body : leaving_) Leave(body);
}

/// Moves a body along its path. Each message begins another path; the body is placed on it and gets
/// the path's velocity, not that of the jump. The view glides over.
BodyState Display::Along(int body, const BodyState& here, const PathSpeed& speed,
                         const BodyState& state) {
  BodyState along = here;
  along.angle = UnwrapAngle(here.angle, state.angle);
  along.velocity = speed.velocity;
  along.spin = speed.spin;
  BodyState jump = Minus(along, state);
  if (std::fabs(jump.angle) > kTurnSeen) jump.angle = 0;
  jump.spin = 0;
  // Velocity changes by gravity and bounces, and those along a path of the past, are no jumps.
  if (snapshots_.falls(body) || !config_.policy->Reckons()) jump.velocity.setZero();
  if (!shown_[body].past) smoother_.Moved(body, jump);
  return along;
}

bool Display::IsOff(int mechanism) const {
  const std::vector<int>& bodies = joints_.bodies(mechanism);
  return corrected_until_[mechanism] > glides_ ||
         std::any_of(bodies.begin(), bodies.end(),
                     [&](int body) { return smoother_.active(body); });
}

template <class Visit>
void Display::EachShown(const Roles& roles, bool all, const Visit& visit) const {
  if (all) {
    for (int body = 0; body < world_.body_count(); ++body) visit(body);
    return;
  }
  for (const int body : world_.present()) {
    if (roles.RoleOf(world_.mechanism(body)) != kRoleRemote) visit(body);
  }
}

const BodyColumn<BodyState>& Display::ShownPoses(const Roles& roles, bool all) const {
  EachShown(roles, all, [&](int body) {
    BodyState& pose = poses_[body];
    pose = Base(body);
    pose.position += smoother_.offset(body);
    pose.angle += smoother_.angle_offset(body);
  });
  EachShown(roles, all, [&](int body) {
    const int m = world_.mechanism(body);
    if (!joints_.jointed(m) || joints_.bodies(m).front() != body) return;
    const bool simulated = roles.Simulates(body);
    // A simulated mechanism without corrections is displayed at its simulated poses.
    if (!simulated || IsOff(m)) joints_.Close(m, simulated, &poses_.values());
  });
  return poses_;
}

View Display::MakeView(const Roles& roles, bool all) const {
  const BodyColumn<BodyState>& poses = ShownPoses(roles, all);
  View view;
  view.peer = roles.self();
  view.tick = world_.tick();
  view.revision = world_.topology().revision();
  EachShown(roles, all, [&](int body) {
    const int m = world_.mechanism(body);
    const BodyState& s = poses[body];
    view.id.push_back(world_.id(body));
    view.role.push_back(roles.RoleOf(m));
    view.authority.push_back(static_cast<std::int16_t>(roles.table().at(m).authority));
    view.x.push_back(s.position.x());
    view.y.push_back(s.position.y());
    view.angle.push_back(s.angle);
    view.vx.push_back(s.velocity.x());
    view.vy.push_back(s.velocity.y());
    view.spin.push_back(s.spin);
    view.age.push_back(static_cast<float>(AgeOf(roles, body)));
  });
  return view;
}

}  // namespace seam
