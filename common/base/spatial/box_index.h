#pragma once
/// Index of numbered boxes that rarely move; finds those that overlap a rectangle without checking
/// all of them.

#include <cstddef>
#include <optional>
#include <vector>

#include "common/base/spatial/box_grid.h"

namespace seam {

/// `Box` has the corners `min` and `max`, m.
template <class Box>
class BoxIndex {
 public:
  /// Removes all boxes. Numbers must be below `numbers`.
  void Clear(std::size_t numbers) {
    entry_.assign(numbers, -1);
    entries_.clear();
    in_grid_ = 0;
    grid_.reset();
  }
  std::size_t numbers() const { return entry_.size(); }
  bool Has(int number) const { return entry_[static_cast<std::size_t>(number)] >= 0; }
  /// Returns the box of a number. Requires Has.
  const Box& at(int number) const {
    return entries_[static_cast<std::size_t>(entry_[static_cast<std::size_t>(number)])].box;
  }
  /// Sets or moves the box of a number.
  void Put(int number, const Box& box) {
    entry_[static_cast<std::size_t>(number)] = static_cast<int>(entries_.size());
    entries_.push_back({number, box});
  }
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
  void EachWithin(const Eigen::Vector2f& min, const Eigen::Vector2f& max,
                  const Visit& visit) const {
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
    Box box;
  };
  static bool Overlap(const Box& box, const Eigen::Vector2f& min, const Eigen::Vector2f& max) {
    return box.min.x() <= max.x() && min.x() <= box.max.x() && box.min.y() <= max.y() &&
           min.y() <= box.max.y();
  }
  void Rebuild() {
    std::size_t left = 0;
    std::vector<Box> boxes;
    boxes.reserve(entries_.size());
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      int& entry = entry_[static_cast<std::size_t>(entries_[i].number)];
      if (entry != static_cast<int>(i)) continue;
      entry = static_cast<int>(left);
      boxes.push_back(entries_[i].box);
      entries_[left++] = entries_[i];
    }
    entries_.resize(left);
    in_grid_ = left;
    grid_.emplace(boxes);
  }

  std::vector<int> entry_;      // by number: index in entries_; -1: no box
  std::vector<Entry> entries_;  // some are outdated
  std::size_t in_grid_ = 0;     // number of entries in the grid; later ones are not
  std::optional<BoxGrid> grid_;
};

}  // namespace seam
