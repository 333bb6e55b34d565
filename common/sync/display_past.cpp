/// Displays others' bodies as they were some ticks ago (ShowAge).

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/sync/display.h"
#include "common/sync/state_arithmetic.h"

namespace seam {

bool Display::ShowsPast(const Roles& roles) const {
  if (config_.show_age_ticks == 0 || config_.smooth_rate <= 0 || roles.self() == 0) return false;
  return config_.policy->Reckons() || config_.policy->GoesBack(roles.self());
}

BodyState Display::Base(int body) const {
  const Shown& shown = shown_[body];
  return shown.past && !memory_.parked(body) ? shown.then : world_.Read(body);
}

/// Returns a body's state at a past moment: simulated where this peer goes back, else between the
/// states received.
BodyState Display::PastAt(const Roles& roles, int body, double moment) const {
  const bool replayed = roles.Simulates(body) && config_.policy->GoesBack(roles.self());
  if (!replayed && snapshots_.has(body)) {
    if (!world_.awake(body)) return world_.Read(body);  // at its exact pose of rest
    BodyState state = delayed_.At(body, moment);
    state.angle = UnwrapAngle(state.angle, world_.Read(body).angle);
    return state;
  }
  const double low = std::floor(moment);
  const BodyState* before = memory_.history().At(static_cast<std::int64_t>(low), body);
  if (before == nullptr) return world_.Read(body);
  if (moment == low) return *before;
  const BodyState* after = memory_.history().At(static_cast<std::int64_t>(low) + 1, body);
  return PlusScaled(*before, Minus(*after, *before), static_cast<float>(moment - low));
}

/// Displays a body `due` ticks ago, or as near to that as the glide of its moment lets it. Hides
/// the change of its past since the last tick.
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
    if (!is_new || now - shown.moment > due) {
      shown.moment = ShowAge::Glide(shown.moment, now, due);
    }
    shown.moment = std::min(std::max(shown.moment, known), now);
  } else {
    if (shown.since < 0) shown.since = world_.tick();
    shown.moment = now;
    jump = Minus(PastAt(roles, body, now), world_.Read(body));
  }
  shown.past = true;
  shown.then = PastAt(roles, body, shown.moment);
  jump.angle = WrapAngle(jump.angle);
  smoother_.Moved(body, Visible(body, jump));
}

/// Displays a body in the present from now on.
void Display::ShowPresent(int body) {
  Shown& shown = shown_[body];
  if (!shown.past) return;
  smoother_.Moved(body, Visible(body, Minus(world_.Read(body), shown.then)));
  shown.past = false;
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
void Display::ShowOthers(const Roles& roles, std::int64_t missing) {
  if (!ShowsPast(roles)) return;
  ages_.Look(roles, missing);
  for (const int body : memory_.unparked()) {
    const int m = world_.mechanism(body);
    const bool own = roles.own_player() >= 0 && roles.Drives(m);
    if (own || IsDelayed(roles, body)) {
      ShowPresent(body);
    } else {
      ShowPast(roles, body, ages_.Due(m));
    }
  }
}

}  // namespace seam
