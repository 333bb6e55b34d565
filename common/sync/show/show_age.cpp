#include "common/sync/show/show_age.h"

#include <algorithm>
#include <limits>

#include "common/sync/reach/reach.h"

namespace seam {
namespace {

/// A body may be older than one that it touches while it has moved by less than this since, m: a
/// shallower overlap is not noticed (kOverlapFloor of the measures).
constexpr float kLateWay = 0.03f;
constexpr double kForEver = std::numeric_limits<double>::infinity();

/// Returns the age in which a body moves by kLateWay, ticks.
double AgeOfWay(const MovingBox& box, float dt) {
  const float way = box.velocity.norm() * dt;
  return way > 0 ? static_cast<double>(kLateWay / way) : kForEver;
}

}  // namespace

double ShowAge::Glide(double moment, double now, double due) {
  return std::clamp(now - due, moment + 1 - double{kAgeRise}, moment + 1 + double{kAgeFall});
}

/// Finds the mechanisms that may touch within `ticks_max`.
void ShowAge::FindMeetings(double ticks_max) {
  boxes_.clear();
  for (const int body : world_.present()) boxes_.push_back(BoxOf(world_, body));
  std::sort(boxes_.begin(), boxes_.end(),
            [](const MovingBox& a, const MovingBox& b) { return a.group < b.group; });
  const auto of = [this](int mechanism) {
    const auto below = [](const MovingBox& box, int m) { return box.group < m; };
    const auto first = std::lower_bound(boxes_.begin(), boxes_.end(), mechanism, below);
    return std::pair(first, std::lower_bound(first, boxes_.end(), mechanism + 1, below));
  };
  meetings_.clear();
  const float dt = world_.dt();
  for (const auto& [a, b] : MeetingGroups(boxes_, static_cast<float>(ticks_max) * dt)) {
    const auto [a_first, a_last] = of(a);
    const auto [b_first, b_last] = of(b);
    Meeting meeting{a, b, kForEver, kForEver};
    for (auto i = a_first; i != a_last; ++i) {
      for (auto j = b_first; j != b_last; ++j) {
        const auto ticks = static_cast<double>(TimeToTouch(*i, *j, kPressGap) / dt);
        if (!(ticks < ticks_max)) continue;
        const double left = double{kAgeFall} * ticks;
        meeting.a_older = std::min(meeting.a_older, std::max(left, AgeOfWay(*i, dt)));
        meeting.b_older = std::min(meeting.b_older, std::max(left, AgeOfWay(*j, dt)));
      }
    }
    if (meeting.a_older < kForEver || meeting.b_older < kForEver) meetings_.push_back(meeting);
  }
}

void ShowAge::Look(const Roles& roles, std::int64_t missing) {
  missing_.Add(missing);
  const auto asked = static_cast<double>(config_.show_age_ticks);
  const double most = std::min(static_cast<double>(missing_.Most()), asked);
  std::fill(due_.begin(), due_.end(), most);
  if (most <= 0 || roles.own_player() < 0) return;
  for (int m = 0; m < due_.size(); ++m) {
    if (roles.Drives(m)) due_[m] = 0;
  }
  FindMeetings(most / double{kAgeFall});
  const auto lower = [this](int m, double due) {
    const bool lowers = due < due_[m];
    if (lowers) due_[m] = due;
    return lowers;
  };
  // Each round passes ages on from mechanism to mechanism, until none falls any more.
  for (bool changed = true; changed;) {
    changed = false;
    for (const Meeting& meeting : meetings_) {
      changed = lower(meeting.b, due_[meeting.a] + meeting.b_older) || changed;
      changed = lower(meeting.a, due_[meeting.b] + meeting.a_older) || changed;
    }
  }
}

}  // namespace seam
