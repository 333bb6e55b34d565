#include "common/sync/reach/reach.h"

#include <algorithm>
#include <tuple>

#include "common/sync/reach/driven.h"

namespace seam {
namespace {

/// A player of whom nothing was heard for so long is not there: nobody waits for it. In a quiet
/// room inputs come once a second. s
constexpr double kSilent = 3.0;

}  // namespace

MovingBox BoxOf(const World& world, int body) {
  MovingBox box;
  std::tie(box.min, box.max) = world.Bounds(body);
  box.velocity = world.Read(body).velocity;
  box.group = world.mechanism(body);
  return box;
}

std::vector<MovingBox> BoxesOf(const World& world, const Drivers& drivers, bool absent_too) {
  std::vector<MovingBox> boxes;
  boxes.reserve(static_cast<std::size_t>(world.body_count()));
  for (int body = 0; body < world.body_count(); ++body) {
    if (!absent_too && world.motion(body) == Motion::kAbsent) continue;
    MovingBox box = BoxOf(world, body);
    if (drivers.Driven(box.group)) box.acceleration = kDrivenAcceleration;
    boxes.push_back(box);
  }
  return boxes;
}

void Reach::Look() {
  const std::int64_t now = world_.tick();
  const std::size_t count = world_.composition().mechanisms.size();
  complete_.assign(count, now);
  // By player: how much of the past is not known; -1: own, or not there.
  std::vector<std::int64_t> missing(inputs_.size(), -1);
  std::int64_t longest = 0;
  for (std::size_t p = 0; p < inputs_.size(); ++p) {
    const std::int64_t newest = inputs_[p].newest();
    if (static_cast<int>(p) == roles_.own_player() || newest < 0) continue;
    if (!drivers_.Concerns(static_cast<int>(p))) continue;  // seldom heard of, and of no matter
    if (newest < now - static_cast<std::int64_t>(kSilent * config_.tick_hz)) continue;
    missing[p] = std::max<std::int64_t>(0, now - newest);
    longest = std::max(longest, missing[p]);
  }
  const bool nobody =
      std::all_of(missing.begin(), missing.end(), [](std::int64_t ticks) { return ticks < 0; });
  if (nobody) return;
  const float seconds = static_cast<float>(longest + 2 * config_.send_every()) * world_.dt();
  const std::vector<int> island =
      Components(static_cast<int>(count), MeetingGroups(BoxesOf(world_, drivers_, false), seconds));
  std::vector<std::int64_t> of_island(count, now);
  for (std::size_t p = 0; p < inputs_.size(); ++p) {
    if (missing[p] < 0) continue;
    for (const int m : drivers_.MechanismsOf(static_cast<int>(p))) {
      const auto i = static_cast<std::size_t>(island[static_cast<std::size_t>(m)]);
      of_island[i] = std::min(of_island[i], now - missing[p]);
    }
  }
  for (std::size_t m = 0; m < count; ++m) {
    complete_[m] = of_island[static_cast<std::size_t>(island[m])];
  }
}

}  // namespace seam
