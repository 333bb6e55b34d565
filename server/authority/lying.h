#pragma once
/// What lies asleep, is the server's, and concerns nobody: a plan needs to see of it only what
/// something else may come to. Kept from plan to plan, so that what lies costs a plan next to
/// nothing.

#include <cstddef>
#include <optional>
#include <vector>

#include "common/sync/reach/zones.h"
#include "server/authority/box_grid.h"
#include "server/authority/plan.h"

namespace seam {

/// How far a plan sees from what does not lie.
struct PlanSight {
  float seconds = 0;  ///< ahead
  float around = 0;   ///< m
};
/// Of these players: as far ahead as it looks for what may meet, and their buffer zone.
PlanSight SightOf(const AuthorityView& view);

class Lying {
 public:
  /// Of so many mechanisms none lies.
  void Clear(std::size_t mechanisms);
  std::size_t size() const { return entry_.size(); }  ///< mechanisms
  bool Has(int mechanism) const { return entry_[static_cast<std::size_t>(mechanism)] >= 0; }
  /// It lies within that box, from now on.
  void Put(int mechanism, const MovingBox& box);
  /// It lies no more, if it did.
  void Take(int mechanism) {
    if (!entry_.empty()) entry_[static_cast<std::size_t>(mechanism)] = -1;
  }

  /// What of it a plan has to see, ascending: what `boxes` (of all that does not lie) may touch in
  /// the time that the plan looks ahead, directly or through others that lie, and what is around
  /// any of those.
  std::vector<int> Near(const std::vector<MovingBox>& boxes, const PlanSight& sight);

 private:
  struct Entry {
    int mechanism = 0;
    MovingBox box;
  };
  void Rebuild();
  template <class Visit>
  void EachWithin(const Vec2& min, const Vec2& max, const Visit& visit) const;

  std::vector<int> entry_;      // by mechanism: its place in entries_; -1: it does not lie
  std::vector<Entry> entries_;  // some are of what does not lie there any more
  std::size_t in_grid_ = 0;     // of them; the others came later
  std::optional<BoxGrid> grid_;
  int looks_ = 0;
  std::vector<int> found_in_;  // by mechanism: the last look that found it
};

}  // namespace seam
