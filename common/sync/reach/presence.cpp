#include "common/sync/reach/presence.h"

#include <algorithm>
#include <utility>

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

/// Boxes in the order of their left sides, grown by the way that each can make.
class Sorted {
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
  std::vector<MovingBox> boxes_;
  float way_ = 0, widest_ = 0;
  float low_ = 1e30f, high_ = -1e30f;  // m
};

}  // namespace

Presence::Presence(const SyncConfig& config, const World& world, const Roles& roles,
                   const BodyMemory& memory)
    : config_(config), world_(world), roles_(roles), memory_(memory) {
  Remap();
}

void Presence::Remap() {
  near_.assign(world_.composition().mechanisms.size(), 1);
  unwatched_.clear();
  around_.min.setConstant(-1e9f);
  around_.max.setConstant(1e9f);
}

bool Presence::LookIfDue() {
  if (config_.mode != Mode::kBuffer) return false;
  if (world_.tick() % std::max(1, config_.tick_hz / kLooksPerSecond) != 0) return false;
  Look();
  return true;
}

void Presence::Look() {
  std::vector<MovingBox> simulated;
  std::vector<int> displayed;
  for (const int body : memory_.tended()) {
    if (roles_.Simulates(body)) {
      if (!Unwatched(body)) simulated.push_back(FreeBoxOf(world_, body));
    } else {
      displayed.push_back(body);
    }
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
  // What is simulated would be near if it ceased to be.
  for (const int body : world_.present()) {
    if (roles_.Simulates(body)) near[static_cast<std::size_t>(world_.mechanism(body))] = 1;
  }
  near_ = std::move(near);
}

}  // namespace seam
