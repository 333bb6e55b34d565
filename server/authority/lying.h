#pragma once
/// What lies asleep, is the server's, and concerns nobody: a plan needs to see of it only what
/// something else may come to. Kept from plan to plan, so that what lies costs a plan next to
/// nothing.

#include <cstddef>
#include <vector>

#include "common/sync/reach/kept_boxes.h"
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
  std::size_t size() const { return boxes_.numbers(); }  ///< mechanisms
  bool Has(int mechanism) const { return boxes_.Has(mechanism); }
  /// It lies within that box, from now on.
  void Put(int mechanism, const MovingBox& box) { boxes_.Put(mechanism, box); }
  /// It lies no more, if it did.
  void Take(int mechanism) { boxes_.Take(mechanism); }

  /// What of it a plan has to see, ascending: what `boxes` (of all that does not lie) may touch in
  /// the time that the plan looks ahead, directly or through others that lie, and what is around
  /// any of those.
  std::vector<int> Near(const std::vector<MovingBox>& boxes, const PlanSight& sight);

 private:
  KeptBoxes boxes_;
  int looks_ = 0;
  std::vector<int> found_in_;  // by mechanism: the last look that found it
};

}  // namespace seam
