#pragma once
/// Simulates the strands of a scene for one peer's view: each hangs on the displayed pose of its
/// part.

#include <map>

#include "common/codec/messages.h"
#include "common/physics/hanging_rope.h"
#include "common/physics/world.h"

namespace seam {

class StrandView {
 public:
  /// The world must outlive this.
  explicit StrandView(const World& world) : world_(world) {}

  /// Advances the strands by the ticks since the last view. A strand without its part is left out.
  /// utime is left 0; no points: nothing to publish.
  Strands Next(const View& view);

 private:
  const World& world_;
  std::map<int, HangingRope> ropes_;  // by index of the strand
  std::int64_t tick_ = 0;
};

}  // namespace seam
