#include "common/sync/display.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/sync/reconcile/reconcile.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// Ticks from one look at the path of what touches nothing to the next: between them it goes
/// straight on.
constexpr int kAbsentEvery = 6;

/// Kinematic bodies are not made to spin faster than this, rad/s: the engine clamps at 94.
constexpr float kSpinDrivenMax = 90.0f;
/// A turn of more than this within a tick is taken for a fast wheel's, whose angle nobody follows.
constexpr float kTurnSeen = 0.5f;

/// A body that spins faster than this, rad/s, hides a jump of its angle by what it turns in
/// kTurnsHidden ticks.
constexpr float kSpinSeen = 6, kTurnsHidden = 1;
/// So long after a correction the engine may still be closing what it has torn, ticks.
constexpr int kCorrectedTicks = 10;

float TurnTo(float from, float to) { return WrapAngle(to - from); }

}  // namespace

Display::Display(const SyncConfig& config, World& world, const Snapshots& snapshots)
    : config_(config),
      world_(world),
      snapshots_(snapshots),
      smoother_(world.body_count(), config.smooth),
      delay_(config.send_every()),
      joints_(world),
      reckoner_(world, snapshots, joints_),
      corrected_ticks_(world.composition().mechanisms.size(), 0),
      left_(static_cast<std::size_t>(world.body_count()), 0) {}

/// What a person could see of a jump: a wheel that spins turns by so much in every tick that
/// nobody can tell a correction of less, and gliding over it would show it wrong for longer.
BodyState Display::Visible(int body, BodyState jump) const {
  const float spin = std::fabs(world_.Read(body).spin);
  if (spin < kSpinSeen) return jump;
  const float turn = kTurnsHidden * spin * world_.dt();
  jump.angle -= std::clamp(jump.angle, -turn, turn);
  jump.spin = 0;
  return jump;
}

void Display::Moved(int body, const BodyState& by) {
  if (!Negligible(by)) on_corrected_(body);
  smoother_.Moved(body, Visible(body, by));
  corrected_ticks_[static_cast<std::size_t>(world_.mechanism(body))] = kCorrectedTicks;
}

void Display::Remap(const BodyRemap& change) {
  std::vector<int> from;
  for (const BodyOrigin& origin : change.bodies) from.push_back(origin.body);
  smoother_.Remap(from);
  joints_.Rebuild();
  corrected_ticks_.assign(world_.composition().mechanisms.size(), 0);
  left_.assign(static_cast<std::size_t>(world_.body_count()), 0);
  if (config_.mode == Mode::kOracle) return;  // the oracle hides nothing
  for (std::size_t body = 0; body < change.jumps.size(); ++body) {
    smoother_.Moved(static_cast<int>(body), change.jumps[body]);
  }
}

void Display::Glide(const Roles& roles) {
  const int mechanisms = static_cast<int>(world_.composition().mechanisms.size());
  for (int m = 0; m < mechanisms; ++m) {
    const std::vector<int>& bodies = joints_.bodies(m);
    int& corrected = corrected_ticks_[static_cast<std::size_t>(m)];
    corrected = std::max(0, corrected - 1);
    if (!config_.smooth) continue;
    if (bodies.size() == 1) {
      const int body = bodies.front();
      smoother_.Advance(body, world_.dt(), world_.Read(body).velocity.norm());
    } else {
      smoother_.AdvanceTogether(world_, bodies);
    }
  }
  if (config_.smooth) KeepClosed(roles);
}

/// What closing has moved becomes part of the offset and returns with it: closed anew from torn
/// poses in every tick, the view would jump whenever physics does.
void Display::KeepClosed(const Roles& roles) {
  const std::vector<BodyState> poses = ShownPoses(roles, config_.shows_far);
  for (int body = 0; body < world_.body_count(); ++body) {
    const int m = world_.mechanism(body);
    if (!joints_.jointed(m) || (!config_.shows_far && roles.RoleOf(m) == kRoleRemote)) continue;
    smoother_.Set(body, Minus(poses[static_cast<std::size_t>(body)], world_.Read(body)));
  }
}

/// By what was heard of it last, cheaply.
bool Display::IsOutside(int body, std::int64_t next, const MovingBox& seen) const {
  if (!snapshots_.has(body)) return false;
  const BodyState& heard = snapshots_.newest(body);
  const std::int64_t newest = snapshots_.newest_tick(body);
  const float forward = Snapshots::Forward(newest, next, world_.dt(), kReckonMax);
  const Vec2 at = heard.position + forward * heard.velocity;
  return at.x() < seen.min.x() || at.y() < seen.min.y() || at.x() > seen.max.x() ||
         at.y() > seen.max.y();
}

void Display::Drive(std::int64_t next, const MovingBox& seen) {
  if (config_.mode == Mode::kOracle) return;  // nothing is only displayed
  const double delay = delay_.Advance();
  reckoner_.Begin(next);
  for (int body = 0; body < world_.body_count(); ++body) {
    const Motion motion = world_.motion(body);
    if (motion == Motion::kDynamic) continue;
    if (motion == Motion::kAbsent && (next + world_.mechanism(body)) % kAbsentEvery != 0) continue;
    char& left = left_[static_cast<std::size_t>(body)];
    const bool outside =
        !config_.shows_far && motion == Motion::kAbsent && IsOutside(body, next, seen);
    if (!outside && left != 0) smoother_.Reset(body);
    if (outside && left == 0) {
      BodyState still = world_.Read(body);
      still.velocity.setZero();
      still.spin = 0;
      world_.Write(body, still, false);
    }
    left = outside ? 1 : 0;
    if (outside) continue;
    BodyState state = world_.Read(body);
    if (!snapshots_.has(body)) {
      state.velocity.setZero();
      state.spin = 0;
    } else if (config_.mode == Mode::kBuffer) {
      state = AlongReckoned(body, state);
    } else {
      state = AlongSnapshots(body, snapshots_.Interpolate(body, static_cast<double>(next) - delay),
                             state);
    }
    const bool moves = state.velocity.squaredNorm() > 0 || state.spin != 0;
    world_.Write(body, state, moves);
  }
}

/// In the past, between snapshots: the path has no jumps, so its steps are the velocity.
BodyState Display::AlongSnapshots(int body, const BodyState& target, BodyState state) {
  state.velocity = (target.position - state.position) / world_.dt();
  if (state.velocity.norm() > world_.scene().speed_limit) {
    // Too far to travel in a tick: it is placed there at once.
    BodyState jump;
    jump.position = target.position - state.position;
    smoother_.Moved(body, jump);
    state.position = target.position;
    state.velocity.setZero();
  }
  // A fast wheel turns by more than the wire's angle can tell: it spins as it should and its
  // angle is placed.
  const float turn = TurnTo(state.angle, target.angle);
  const bool fast = std::fabs(turn) > kSpinDrivenMax * world_.dt();
  state.spin = fast ? target.spin : turn / world_.dt();
  if (fast) state.angle += turn - target.spin * world_.dt();
  return state;
}

/// In the present, by dead reckoning: each message begins another path. The body is placed on it
/// and moves with the path's velocity, not with that of the jump; the view glides over.
BodyState Display::AlongReckoned(int body, BodyState state) {
  const BodyState here = reckoner_.Here(body), there = reckoner_.There(body);
  BodyState along = here;
  along.angle = state.angle + TurnTo(state.angle, here.angle);
  along.velocity = (there.position - here.position) / world_.dt();
  along.spin = (there.angle - here.angle) / world_.dt();
  BodyState jump = Minus(along, state);
  if (std::fabs(jump.angle) > kTurnSeen) jump.angle = 0;
  jump.spin = 0;
  smoother_.Moved(body, jump);
  return along;
}

bool Display::IsOff(int mechanism) const {
  const std::vector<int>& bodies = joints_.bodies(mechanism);
  return corrected_ticks_[static_cast<std::size_t>(mechanism)] > 0 ||
         std::any_of(bodies.begin(), bodies.end(),
                     [&](int body) { return smoother_.active(body); });
}

std::vector<BodyState> Display::ShownPoses(const Roles& roles, bool all) const {
  std::vector<BodyState> poses(static_cast<std::size_t>(world_.body_count()));
  for (int body = 0; body < world_.body_count(); ++body) {
    if (!all && roles.RoleOf(world_.mechanism(body)) == kRoleRemote) continue;
    BodyState& pose = poses[static_cast<std::size_t>(body)];
    pose = world_.Read(body);
    pose.position += smoother_.offset(body);
    pose.angle += smoother_.angle_offset(body);
  }
  const int mechanisms = static_cast<int>(world_.composition().mechanisms.size());
  for (int m = 0; m < mechanisms; ++m) {
    if (!joints_.jointed(m) || (!all && roles.RoleOf(m) == kRoleRemote)) continue;
    const bool simulated = roles.Simulates(joints_.bodies(m).front());
    // What physics made of a simulated mechanism is shown as it is.
    if (!simulated || IsOff(m)) joints_.Close(m, simulated, &poses);
  }
  return poses;
}

View Display::MakeView(const Roles& roles, bool all) const {
  const std::vector<BodyState> poses = ShownPoses(roles, all);
  View view;
  view.peer = roles.self();
  view.tick = world_.tick();
  view.revision = world_.topology().revision();
  for (int body = 0; body < world_.body_count(); ++body) {
    const int m = world_.mechanism(body);
    if (!all && roles.RoleOf(m) == kRoleRemote) continue;
    const BodyState& s = poses[static_cast<std::size_t>(body)];
    view.id.push_back(world_.id(body));
    view.role.push_back(roles.RoleOf(m));
    view.authority.push_back(static_cast<std::int16_t>(roles.table().at(m).authority));
    view.x.push_back(s.position.x());
    view.y.push_back(s.position.y());
    view.angle.push_back(s.angle);
    view.vx.push_back(s.velocity.x());
    view.vy.push_back(s.velocity.y());
    view.spin.push_back(s.spin);
  }
  return view;
}

}  // namespace seam
