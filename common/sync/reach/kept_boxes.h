#pragma once
/// Index of numbered boxes that rarely move; finds those that overlap a rectangle without checking
/// all of them.

#include <cstddef>
#include <optional>
#include <vector>

#include "common/sync/reach/box_grid.h"

namespace seam {

class KeptBoxes {
 public:
  /// Removes all boxes. Numbers must be below `numbers`.
  void Clear(std::size_t numbers);
  std::size_t numbers() const { return entry_.size(); }
  bool Has(int number) const { return entry_[static_cast<std::size_t>(number)] >= 0; }
  /// Returns the box of a number. Requires Has.
  const MovingBox& at(int number) const {
    return entries_[static_cast<std::size_t>(entry_[static_cast<std::size_t>(number)])].box;
  }
  /// Sets or moves the box of a number.
  void Put(int number, const MovingBox& box);
  /// Removes the box of a number; does nothing if there is none.
  void Take(int number) {
    if (!entry_.empty()) entry_[static_cast<std::size_t>(number)] = -1;
  }
  /// Call now and then while no EachWithin runs. Rebuilds the grid if many boxes were put since the
  /// last time.
  void Tidy() {
    if (entries_.size() - in_grid_ > kLateMost + entries_.size() / kLateShare) Rebuild();
  }
  /// Calls `visit(number, box)` once for each box that overlaps the rectangle.
  template <class Visit>
  void EachWithin(const Vec2& min, const Vec2& max, const Visit& visit) const {
    const auto look = [&](std::size_t i) {
      const Entry& entry = entries_[i];
      const bool kept = entry_[static_cast<std::size_t>(entry.number)] == static_cast<int>(i);
      if (kept && Overlap(entry.box, min, max)) visit(entry.number, entry.box);
    };
    if (grid_) grid_->Near(min, max, [&](int i) { look(static_cast<std::size_t>(i)); });
    for (std::size_t i = in_grid_; i < entries_.size(); ++i) look(i);
  }

 private:
  /// The grid is rebuilt when more boxes than kLateMost and than this share of all were put since;
  /// until then they are checked one by one.
  static constexpr std::size_t kLateMost = 16, kLateShare = 64;
  struct Entry {
    int number = 0;
    MovingBox box;
  };
  static bool Overlap(const MovingBox& box, const Vec2& min, const Vec2& max) {
    return box.min.x() <= max.x() && min.x() <= box.max.x() && box.min.y() <= max.y() &&
           min.y() <= box.max.y();
  }
  void Rebuild();

  std::vector<int> entry_;      // by number: index in entries_; -1: no box
  std::vector<Entry> entries_;  // some are outdated
  std::size_t in_grid_ = 0;     // number of entries in the grid; later ones are not
  std::optional<BoxGrid> grid_;
};

}  // namespace seam
