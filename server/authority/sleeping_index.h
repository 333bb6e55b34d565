#pragma once
/// Index of sleeping mechanisms of the server that nobody follows; a plan loads only those that a
/// moving body may reach. Kept from plan to plan, so that sleeping mechanisms cost a plan almost
/// nothing.

#include <cstddef>
#include <vector>

#include "common/base/spatial/box_index.h"
#include "server/authority/plan.h"

namespace seam {

/// Reach of a plan around bodies that are not in the index.
struct PlanSight {
  float seconds = 0;  ///< ahead
  float around = 0;   ///< distance, m
};
/// Returns the look-ahead for contacts, with the longest delay of these players, and their buffer
/// zone.
PlanSight SightOf(const AuthorityView& view);

class SleepingIndex {
 public:
  /// Sets the number of mechanisms; none is in the index.
  void Clear(std::size_t mechanisms);
  std::size_t size() const { return boxes_.numbers(); }  ///< mechanisms
  bool Has(int mechanism) const { return boxes_.Has(mechanism); }
  /// Adds a mechanism within that box, or moves it there.
  void Put(int mechanism, const MovingBox& box) { boxes_.Put(mechanism, box); }
  /// Removes a mechanism, if present.
  void Take(int mechanism) { boxes_.Take(mechanism); }

  /// Returns the mechanisms that a plan needs, ascending. These are the ones that `boxes` (all
  /// bodies not in the index) may touch within the look-ahead, directly or through others of the
  /// index, and all within `sight.around` of any of them.
  std::vector<int> Near(const std::vector<MovingBox>& boxes, const PlanSight& sight);

 private:
  BoxIndex<MovingBox> boxes_;
  int looks_ = 0;
  std::vector<int> found_in_;  // rebuilt by Clear, by mechanism: last search that found it
};

}  // namespace seam
