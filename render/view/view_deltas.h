#pragma once
/// Views of a running session as few bytes: each body's change from a straight line through the two
/// poses that were sent before, in whole millimetres and milliradians. A body at rest, or one that
/// moves evenly, costs nothing.
///
/// Format of a frame, all numbers varints (render/page/column.h); render/page/tape.js reads it:
///
///   peer; tick (signed); index of the world; 1 if the frame stands for itself, else 0
///   number of bodies that are no longer shown; for each: its id less the one before less 1
///   number of bodies that differ from the prediction; for each:
///     2 * (its id less the one before less 1), plus 1 if its owner follows
///     owner: 3 * authority + role
///     x, y, angle: signed, less the prediction
///
/// The prediction of a body is its last value plus its last step; both are 0 for one that was not
/// shown before, and the step is 0 at its first frame. A frame that stands for itself forgets all
/// bodies first.

#include <array>
#include <cstdint>
#include <vector>

#include "render/page/column.h"

namespace seam {

/// A view, rounded.
struct ViewFrame {
  struct Body {
    int id = 0;
    std::array<std::int64_t, 3> pose{};  ///< mm, mm, mrad
    int owner = 0;                       ///< 3 * authority + role
  };
  int peer = 0;
  std::int64_t tick = 0;
  int world = 0;
  std::vector<Body> bodies;  ///< by id, ascending
};

/// Encodes the frames of one peer.
class ViewDeltas {
 public:
  /// Appends a frame. `alone`: it stands for itself.
  void Put(const ViewFrame& frame, bool alone, PageBytes* out);

 private:
  struct Known {
    ViewFrame::Body body;
    std::array<std::int64_t, 3> step{};
  };
  std::vector<Known> known_;  // by id, ascending
};

}  // namespace seam
