#pragma once
/// The strands of a scene as one peer shows them: each hangs on its part where that is shown.

#include <map>

#include "common/codec/messages.h"
#include "common/physics/hanging_rope.h"
#include "common/physics/world.h"

namespace seam {

class StrandView {
 public:
  /// The world must outlive this.
  explicit StrandView(const World& world) : world_(world) {}

  /// Lets the ticks since the last view pass. A strand whose part has left is not shown. utime is
  /// left 0; no points: there is nothing to publish.
  Strands Next(const View& view);

 private:
  const World& world_;
  std::map<int, HangingRope> ropes_;  // by index of the strand
  std::int64_t tick_ = 0;
};

}  // namespace seam
