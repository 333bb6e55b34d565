#pragma once
/// Boxes that mostly stay where they are, each with a number: which of them overlap a rectangle,
/// without a look at all of them.

#include <cstddef>
#include <optional>
#include <vector>

#include "common/sync/reach/box_grid.h"

namespace seam {

class KeptBoxes {
 public:
  /// Numbers are below `numbers`; none is kept.
  void Clear(std::size_t numbers);
  std::size_t numbers() const { return entry_.size(); }
  bool Has(int number) const { return entry_[static_cast<std::size_t>(number)] >= 0; }
  /// Where it is kept. Requires Has.
  const MovingBox& at(int number) const {
    return entries_[static_cast<std::size_t>(entry_[static_cast<std::size_t>(number)])].box;
  }
  /// It is there, from now on.
  void Put(int number, const MovingBox& box);
  /// It is nowhere, if it was anywhere.
  void Take(int number) {
    if (!entry_.empty()) entry_[static_cast<std::size_t>(number)] = -1;
  }
  /// To be called now and then, where no EachWithin runs: what came since is put in order when it
  /// is much.
  void Tidy() {
    if (entries_.size() - in_grid_ > kLateMost + entries_.size() / kLateShare) Rebuild();
  }
  /// Calls `visit` (the number, its box) once for each that overlaps the rectangle.
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
  /// The grid is made anew when more have come since than so many, and than this share of all: they
  /// are looked at one by one.
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

  std::vector<int> entry_;      // by number: its place in entries_; -1: it is not kept
  std::vector<Entry> entries_;  // some are of what is not kept there any more
  std::size_t in_grid_ = 0;     // of them; the others came later
  std::optional<BoxGrid> grid_;
};

}  // namespace seam
