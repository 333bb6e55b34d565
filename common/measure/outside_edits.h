#pragma once
/// The edits of a recording with a cause outside the physics, translated to the ids of a world that
/// found the other edits by itself.

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/measure/revisions.h"
#include "common/record/recording.h"
#include "common/scene/scene.h"
#include "common/topology/edit.h"

namespace seam {

class OutsideEdits {
 public:
  /// Without any edit. `scene`: without any edit; borrowed.
  explicit OutsideEdits(const Scene& scene);

  /// Adds the edits that `recording` has beyond those of the recording before.
  void Add(const Recording& recording);

  /// Removes and returns the edits of all ticks up to this one. `now`: the world's current scene.
  std::vector<Edit> Take(std::int64_t tick, const Scene& now);

 private:
  PartId PartOf(const Scene& then, PartId part, const Scene& now) const;
  std::int32_t JointOf(const Scene& then, std::int32_t joint, const Scene& now) const;
  void Translate(int number, const Scene& now, Edit* edit) const;

  const Scene& scene_;
  std::unique_ptr<const RevisionHistory> recorded_;  // with all edits that were added
  const std::size_t parts_, joints_;                 // counts in the scene without edits
  int next_ = 0;                                     // lowest number that was not added
  std::map<std::int64_t, std::vector<std::pair<int, Edit>>> by_tick_;
};

}  // namespace seam
