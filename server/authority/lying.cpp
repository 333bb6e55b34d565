#include "server/authority/lying.h"

#include <algorithm>
#include <utility>

#include "server/authority/crowds.h"

namespace seam {
namespace {

/// The grid is made anew when more have come since than so many, and than this share of all: they
/// are looked at one by one.
constexpr std::size_t kLateMost = 16, kLateShare = 64;
/// m, so that no rounding leaves out what is just as far as it may be.
constexpr float kRounding = 0.1f;

bool Overlap(const MovingBox& box, const Vec2& min, const Vec2& max) {
  return box.min.x() <= max.x() && min.x() <= box.max.x() && box.min.y() <= max.y() &&
         min.y() <= box.max.y();
}

}  // namespace

PlanSight SightOf(const AuthorityView& view) {
  float longest = 0;
  for (const PlayerView& player : view.players) longest = std::max(longest, player.one_way_s);
  return {ZoneSeconds(longest, longest) + kZoneKeep, view.buffer_m + kHysteresis};
}

void Lying::Clear(std::size_t mechanisms) {
  entry_.assign(mechanisms, -1);
  found_in_.assign(mechanisms, 0);
  looks_ = 0;
  entries_.clear();
  in_grid_ = 0;
  grid_.reset();
}

void Lying::Put(int mechanism, const MovingBox& box) {
  entry_[static_cast<std::size_t>(mechanism)] = static_cast<int>(entries_.size());
  entries_.push_back({mechanism, box});
}

void Lying::Rebuild() {
  std::size_t left = 0;
  std::vector<MovingBox> boxes;
  boxes.reserve(entries_.size());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    int& entry = entry_[static_cast<std::size_t>(entries_[i].mechanism)];
    if (entry != static_cast<int>(i)) continue;
    entry = static_cast<int>(left);
    boxes.push_back(entries_[i].box);
    entries_[left++] = entries_[i];
  }
  entries_.resize(left);
  in_grid_ = left;
  grid_.emplace(boxes);
}

template <class Visit>
void Lying::EachWithin(const Vec2& min, const Vec2& max, const Visit& visit) const {
  const auto look = [&](std::size_t i) {
    const Entry& entry = entries_[i];
    const bool lies = entry_[static_cast<std::size_t>(entry.mechanism)] == static_cast<int>(i);
    if (lies && Overlap(entry.box, min, max)) visit(entry);
  };
  if (grid_) grid_->Near(min, max, [&](int i) { look(static_cast<std::size_t>(i)); });
  for (std::size_t i = in_grid_; i < entries_.size(); ++i) look(i);
}

std::vector<int> Lying::Near(const std::vector<MovingBox>& boxes, const PlanSight& sight) {
  if (entries_.size() - in_grid_ > kLateMost + entries_.size() / kLateShare) Rebuild();
  ++looks_;
  std::vector<int> found;       // mechanisms
  std::vector<MovingBox> seen;  // their boxes
  const auto take = [&](const Entry& entry) {
    int& found_in = found_in_[static_cast<std::size_t>(entry.mechanism)];
    if (std::exchange(found_in, looks_) == looks_) return;
    found.push_back(entry.mechanism);
    seen.push_back(entry.box);
  };
  const auto within = [&](const MovingBox& box, float reach) {
    const Vec2 by(reach + kRounding, reach + kRounding);
    EachWithin(box.min - by, box.max + by, take);
  };
  for (const MovingBox& box : boxes) within(box, kZoneSlack + WayOf(box, sight.seconds));
  for (std::size_t i = 0; i < seen.size(); ++i) within(MovingBox(seen[i]), kZoneSlack);
  const std::size_t touched = seen.size();
  for (const MovingBox& box : boxes) within(box, sight.around);
  for (std::size_t i = 0; i < touched; ++i) within(MovingBox(seen[i]), sight.around);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace seam
