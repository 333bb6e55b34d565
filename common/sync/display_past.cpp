/// Displays others' bodies as they were some ticks ago (ShowAge).

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/sync/display.h"
#include "common/sync/state_arithmetic.h"

namespace seam {
namespace {

/// Two that touch move as one if one moves by less than this in the other's frame, m, in
/// kTogetherTicks.
constexpr float kTogetherWay = 0.05f;
constexpr int kTogetherTicks = 8;

/// Returns the place of `b` in the frame of `a`.
Vec2 PlaceIn(const BodyState& a, const BodyState& b) {
  return Turned(b.position - a.position, -a.angle);
}

/// Marks the mechanisms, besides the `marked` ones, that touch a marked one and move as one with
/// it: its load, or what it stands on.
void MarkTogether(const World& world, const History& history, std::vector<char>* marked) {
  const std::int64_t now = world.tick();
  const std::int64_t then = std::max(history.oldest(), now - kTogetherTicks);
  for (bool more = true; more;) {
    more = false;
    for (const Touch& touch : world.touches()) {
      const auto a = static_cast<std::size_t>(world.mechanism(touch.body_a));
      const auto b = static_cast<std::size_t>(world.mechanism(touch.body_b));
      if ((*marked)[a] == (*marked)[b]) continue;
      const BodyState* const a_then = history.At(then, touch.body_a);
      const BodyState* const b_then = history.At(then, touch.body_b);
      if (a_then == nullptr || b_then == nullptr) continue;
      const BodyState a_now = world.Read(touch.body_a), b_now = world.Read(touch.body_b);
      const Vec2 moved = PlaceIn(a_now, b_now) - PlaceIn(*a_then, *b_then);
      if (moved.norm() > kTogetherWay) continue;
      (*marked)[a] = (*marked)[b] = 1;
      more = true;
    }
  }
}

}  // namespace

bool Display::ShowsPast(const Roles& roles) const {
  if (config_.show_age_ticks == 0 || config_.smooth_rate <= 0 || roles.self() == 0) return false;
  // A seat would join bodies that are shown at different moments.
  return world_.scene().seats.empty() && config_.policy->ShowsPast(roles.self());
}

BodyState Display::Base(int body) const {
  const Shown& shown = shown_[body];
  return shown.past && !memory_.parked(body) ? shown.then : world_.Read(body);
}

/// Returns a body's state at a past moment: as simulated here, or between the states received.
BodyState Display::PastAt(const Roles& roles, int body, double moment) const {
  if (!roles.Simulates(body) && snapshots_.has(body)) {
    if (!world_.awake(body)) return world_.Read(body);  // at its exact pose of rest
    BodyState state = delayed_.At(body, moment);
    state.angle = UnwrapAngle(state.angle, world_.Read(body).angle);
    return state;
  }
  const double low = std::floor(moment);
  const BodyState* before = memory_.history().At(static_cast<std::int64_t>(low), body);
  if (before == nullptr) return world_.Read(body);
  if (moment == low) return *before;
  const std::int64_t next = static_cast<std::int64_t>(low) + 1;
  BodyState after = *memory_.history().At(next, body);
  if (next == shown_[body].edited) after = Minus(after, shown_[body].jump);
  for (const PastMove& move : shown_[body].moves) {
    if (move.tick == next) after = Minus(after, move.by);
  }
  return PlusScaled(*before, Minus(after, *before), static_cast<float>(moment - low));
}

/// Returns the speed of a mechanism's fastest point, on the screen or now, m/s.
float Display::FastestPoint(int mechanism) const {
  float fastest = 0;
  for (const int body : joints_.bodies(mechanism)) {
    const auto [low, high] = world_.Bounds(body);
    const float radius = (high - low).norm() / 2;
    for (const BodyState& state : {Base(body), world_.Read(body)}) {
      fastest = std::max(fastest, state.velocity.norm() + std::fabs(state.spin) * radius);
    }
  }
  return fastest;
}

/// Moves on a body's moment to `due` ticks ago, or as near to that as its glide lets it. The other
/// bodies of its mechanism follow the first one. Hides the change of its past since the last tick.
void Display::ShowPast(const Roles& roles, int body, double due) {
  Shown& shown = shown_[body];
  const auto now = static_cast<double>(world_.tick());
  const double known = static_cast<double>(std::max(shown.since, memory_.history().oldest()));
  BodyState jump;
  if (shown.past) {
    shown.moment = std::max(shown.moment, std::min(known, now));
    jump = Minus(PastAt(roles, body, shown.moment), shown.then);
    // A body that was not shown before waits for its age. Any other glides.
    const bool is_new = shown.moment == static_cast<double>(shown.since);
    const int m = world_.mechanism(body);
    if (joints_.bodies(m).front() == body && (!is_new || now - shown.moment > due)) {
      const bool has_its_age = shown.moment + 1 == now - due;
      const double speed = has_its_age ? 0 : double{FastestPoint(m)};
      shown.moment = ShowAge::Glide(shown.moment, now, due, speed);
    }
    shown.moment = std::min(std::max(shown.moment, known), now);
  } else {
    if (shown.since < 0) shown.since = world_.tick();
    shown.moment = now;
    jump = Minus(PastAt(roles, body, now), world_.Read(body));
  }
  shown.past = true;
  jump.angle = WrapAngle(jump.angle);
  // The past that is displayed from now on has its own, right velocity.
  jump.velocity.setZero();
  jump.spin = 0;
  smoother_.Moved(body, Visible(body, jump));
}

/// Lets the view glide over the moves that the body's moment has come to.
void Display::HidePastMoves(int body) {
  Shown& shown = shown_[body];
  const auto come = [&](const PastMove& move) {
    return shown.moment >= static_cast<double>(move.tick);
  };
  for (const PastMove& move : shown.moves) {
    if (come(move)) smoother_.Moved(body, move.by);
  }
  shown.moves.erase(std::remove_if(shown.moves.begin(), shown.moves.end(), come),
                    shown.moves.end());
}

void Display::MovedInPast(int body, const BodyState& by) {
  Shown& shown = shown_[body];
  // What is displayed by now is compared as a whole, by ShowPast.
  if (!shown.past || static_cast<double>(world_.tick()) <= shown.moment) return;
  // A replay may begin at a barrier that lacks the move.
  const bool again = !shown.moves.empty() && shown.moves.back().tick == world_.tick();
  if (!again) shown.moves.emplace_back();
  shown.moves.back() = {world_.tick(), Visible(body, by)};
  any_moves_ = true;
}

void Display::ReplayedFrom(std::int64_t tick) {
  if (!std::exchange(any_moves_, false)) return;
  for (int body = 0; body < shown_.size(); ++body) {
    std::vector<PastMove>& moves = shown_[body].moves;
    while (!moves.empty() && moves.back().tick > tick) moves.pop_back();
    any_moves_ = any_moves_ || !moves.empty();
  }
}

/// Displays a body in the present from now on.
void Display::ShowPresent(int body) {
  Shown& shown = shown_[body];
  if (!shown.past) return;
  smoother_.Moved(body, Visible(body, Minus(world_.Read(body), shown.then)));
  shown.past = false;
  shown.edited = -1;
  shown.moves.clear();
}

/// The same for all bodies: the age at which they are displayed has become none.
void Display::ShowAllPresent() {
  if (!std::exchange(any_past_, false)) return;
  for (int body = 0; body < shown_.size(); ++body) ShowPresent(body);
}

/// True if the world itself has the body in the past, between received states.
bool Display::IsDelayed(const Roles& roles, int body) const {
  return !config_.policy->Reckons() && !roles.Simulates(body);
}

double Display::AgeOf(const Roles& roles, int body) const {
  const Shown& shown = shown_[body];
  if (shown.past) return std::max(0.0, static_cast<double>(world_.tick()) - shown.moment);
  return IsDelayed(roles, body) ? delayed_.age() : 0;
}

/// Call after a step, with its tick recorded: chooses the moment at which each body is displayed.
void Display::ShowOthers(const Roles& roles, const MissingInputs& missing) {
  if (!ShowsPast(roles)) return ShowAllPresent();
  any_past_ = true;
  ages_.Look(missing);
  shown_mechanisms_.clear();
  const auto now = static_cast<double>(world_.tick());
  std::vector<char> own(world_.composition().mechanisms.size(), 0);
  for (std::size_t m = 0; m < own.size() && roles.own_player() >= 0; ++m) {
    own[m] = roles.Drives(static_cast<int>(m)) ? 1 : 0;
  }
  std::vector<char> with_own = own;
  MarkTogether(world_, memory_.history(), &with_own);
  // What another player moves, too, is not known in the present.
  for (const Player& player : world_.scene().players) {
    const int m = player.vehicle < 0 ? -1 : MechanismOf(world_, player.vehicle);
    if (m < 0 || own[static_cast<std::size_t>(m)] == with_own[static_cast<std::size_t>(m)])
      continue;
    with_own = own;
    break;
  }
  for (const int body : memory_.unparked()) {
    const int m = world_.mechanism(body);
    const auto index = static_cast<std::size_t>(m);
    const bool past = own[index] == 0 && !IsDelayed(roles, body);
    if (past) {
      ShowPast(roles, body, with_own[index] != 0 ? 0 : ages_.due());
    } else {
      ShowPresent(body);
    }
    const std::vector<int>& bodies = joints_.bodies(m);
    if (bodies.front() == body && (own[index] != 0 || past)) {
      shown_mechanisms_.push_back({&bodies, past ? shown_[body].moment : now});
    }
  }
  KeepApart(
      world_, now - ages_.due(),
      [&](int body, double moment) {
        BodyState pose = shown_[body].past ? PastAt(roles, body, moment) : world_.Read(body);
        pose.position += smoother_.offset(body);
        pose.angle += smoother_.angle_offset(body);
        return pose;
      },
      &shown_mechanisms_);
  for (const ShownMechanism& mechanism : shown_mechanisms_) {
    for (const int body : *mechanism.bodies) {
      Shown& shown = shown_[body];
      if (!shown.past) continue;
      shown.moment = std::max(shown.moment, mechanism.moment);
      if (shown.edited >= 0 && shown.moment >= static_cast<double>(shown.edited)) {
        smoother_.Moved(body, shown.jump);
        shown.edited = -1;
      }
      HidePastMoves(body);
      shown.then = PastAt(roles, body, shown.moment);
    }
  }
}

}  // namespace seam
