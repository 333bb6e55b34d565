#include "common/sync/reach/reach.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/sync/reach/driven.h"

namespace seam {
namespace {

/// A player not heard for this long is absent: no peer waits for its inputs. In a quiet room inputs
/// come once a second. s
constexpr double kSilent = 3.0;
/// The same for a player with all controls released: the server announces a player's departure.
constexpr double kSilentIdle = 1.25;
/// From the room's start, s: a player's first inputs may still be on their way, and only the state
/// of tick 0 is known. Later, a player never heard of is absent.
constexpr double kFirstInputs = 0.75;

/// Returns the box of an anchored part that is not gone.
MovingBox BoxOf(const World& world, PartId id, int group) {
  const Part& part = world.scene().parts[static_cast<std::size_t>(id)];
  const BodyState at = PartPose(world, id);
  std::vector<Vec2> points = part.points;
  for (const float x : {-0.5f, 0.5f}) {
    for (const float y : {-0.5f, 0.5f}) points.push_back({x * part.size.x(), y * part.size.y()});
  }
  MovingBox box;
  box.min = box.max = at.position;
  box.group = group;
  for (const Vec2& point : points) {
    const Vec2 place = at.position + Turned(point, at.angle);
    box.min = box.min.cwiseMin(place);
    box.max = box.max.cwiseMax(place);
  }
  box.min -= Vec2::Constant(part.radius);
  box.max += Vec2::Constant(part.radius);
  return box;
}

}  // namespace

MovingBox BoxOf(const World& world, int body) {
  MovingBox box;
  std::tie(box.min, box.max) = world.Bounds(body);
  box.velocity = world.Read(body).velocity;
  box.group = world.mechanism(body);
  return box;
}

std::vector<MovingBox> BoxesOf(const World& world, const Drivers& drivers,
                               const std::vector<int>& bodies) {
  std::vector<MovingBox> boxes;
  boxes.reserve(bodies.size());
  for (const int body : bodies) {
    MovingBox box = BoxOf(world, body);
    if (drivers.Driven(box.group)) box.acceleration = kDrivenAcceleration;
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<MovingBox> BoxesOf(const World& world, const Drivers& drivers, bool all_bodies) {
  if (!all_bodies) return BoxesOf(world, drivers, world.present());
  std::vector<int> all(static_cast<std::size_t>(world.body_count()));
  std::iota(all.begin(), all.end(), 0);
  return BoxesOf(world, drivers, all);
}

bool Reach::WaitsFor(int player) const {
  if (player == roles_.own_player()) return false;
  const std::int64_t now = world_.tick();
  const InputTrack& track = inputs_[static_cast<std::size_t>(player)];
  const std::int64_t newest = std::max<std::int64_t>(0, track.newest());
  if (track.newest() < 0 && now >= static_cast<std::int64_t>(kFirstInputs * config_.tick_hz)) {
    return false;
  }
  const double silent = track.At(newest) == Input{} ? kSilentIdle : kSilent;
  return newest >= now - static_cast<std::int64_t>(silent * config_.tick_hz);
}

std::vector<std::pair<int, std::int64_t>> Reach::Missing() const {
  std::vector<std::pair<int, std::int64_t>> missing;
  // Inputs of players that do not matter here arrive rarely and are not needed.
  for (const int player : drivers_.concerned()) {
    if (!WaitsFor(player)) continue;
    const InputTrack& track = inputs_[static_cast<std::size_t>(player)];
    const std::int64_t newest = std::max<std::int64_t>(0, track.newest());
    missing.emplace_back(player, std::max<std::int64_t>(0, world_.tick() - newest));
  }
  return missing;
}

std::int64_t Reach::LongestMissing() const {
  std::int64_t longest = 0;
  for (const auto& [player, ticks] : Missing()) longest = std::max(longest, ticks);
  return longest;
}

void Reach::Look() {
  const std::int64_t now = world_.tick();
  const int revision = world_.topology().revision();
  const std::int64_t looked =
      std::exchange(revision_, revision) == revision ? std::min(looked_, now) : -1;
  looked_ = now;
  // What was complete before; the others were at `looked`.
  std::vector<std::pair<int, std::int64_t>> before;
  for (const int m : std::exchange(open_, {})) {
    std::int64_t& complete = complete_[static_cast<std::size_t>(m)];
    before.emplace_back(m, std::exchange(complete, kComplete));
  }
  complete_.resize(world_.composition().mechanisms.size(), kComplete);
  const std::vector<char> waited = std::exchange(waited_, std::vector<char>(inputs_.size(), 0));
  const std::vector<std::pair<int, std::int64_t>> missing = Missing();
  if (missing.empty()) return;
  for (const auto& [player, ticks] : missing) waited_[static_cast<std::size_t>(player)] = 1;
  const int every = std::max(config_.send_every(), BarrierEvery(config_.tick_hz));
  const float seconds = static_cast<float>(LongestMissing() + 2 * every) * world_.dt();
  // The belts of a player are a group behind the mechanisms. Groups are indexed by their place
  // among those present; others meet nothing.
  const auto mechanisms = static_cast<int>(complete_.size());
  std::vector<MovingBox> boxes = BoxesOf(world_, drivers_, false);
  std::vector<int> groups;
  for (const MovingBox& box : boxes) groups.push_back(box.group);
  const auto each_driven = [&](int player, const auto& visit) {
    for (const int m : drivers_.MechanismsOf(player)) visit(m);
    if (drivers_.MovesBelt(player)) visit(mechanisms + player);
  };
  for (const auto& [player, ticks] : missing) {
    each_driven(player, [&](int group) { groups.push_back(group); });
    for (const PartId belt : drivers_.BeltsOf(player)) {
      boxes.push_back(BoxOf(world_, belt, mechanisms + player));
    }
  }
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  const auto place = [&](int m) {
    return static_cast<int>(std::lower_bound(groups.begin(), groups.end(), m) - groups.begin());
  };
  for (MovingBox& box : boxes) box.group = place(box.group);
  const std::vector<int> island =
      Components(static_cast<int>(groups.size()), MeetingGroups(boxes, seconds));
  // By island: of all missing players, and of those that are missed only since the last look, whose
  // boxes did not count until then.
  std::vector<std::int64_t> of_island(groups.size(), now), of_new(groups.size(), now);
  for (const auto& [player, ticks] : missing) {
    const std::int64_t complete = now - ticks;
    const auto p = static_cast<std::size_t>(player);
    const bool counted = p < waited.size() && waited[p] != 0;
    each_driven(player, [&](int group) {
      const auto i = static_cast<std::size_t>(island[static_cast<std::size_t>(place(group))]);
      of_island[i] = std::min(of_island[i], complete);
      if (!counted) of_new[i] = std::min(of_new[i], complete);
    });
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto its = static_cast<std::size_t>(island[i]);
    if (of_island[its] >= now || groups[i] >= mechanisms) continue;
    const auto was =
        std::lower_bound(before.begin(), before.end(), std::pair(groups[i], std::int64_t{-1}));
    const bool opened = was != before.end() && was->first == groups[i];
    const std::int64_t least =
        std::min(opened ? std::min(looked, was->second) : looked, of_new[its]);
    complete_[static_cast<std::size_t>(groups[i])] = std::max(of_island[its], least);
    open_.push_back(groups[i]);
  }
}

std::int64_t Reach::CompleteTickOfAll() const {
  std::int64_t least = looked_;
  for (const int m : open_) least = std::min(least, CompleteTick(m));
  return least;
}

}  // namespace seam
