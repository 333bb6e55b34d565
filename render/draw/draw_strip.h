#pragma once
/// The strip along the bottom: error over time on a logarithmic scale, and a playhead.

#include <cstdint>
#include <string>
#include <vector>

#include "render/canvas/draw_list.h"

namespace seam {

/// One curve of errors by tick.
struct Curve {
  const std::vector<double>* errors_m = nullptr;  ///< borrowed; NaN: unknown
  std::int64_t first_tick = 0;
  int tick_hz = 60;
  Colour colour;
  std::string label;  ///< in the strip's legend; empty: none
  bool bold = true;
};

/// Time range and playhead of the strip.
struct StripLook {
  double from_s = 0, to_s = 1;  ///< the axis
  double now_s = 0;             ///< playhead
};

/// Draws axis, legend and pale curves into `area`. Values below a millimetre lie on the base line.
void DrawStrip(DrawList& list, const Rect& area, const std::vector<Curve>& curves,
               const StripLook& look);
/// Draws the curves up to the playhead, and the playhead, over the result of DrawStrip.
void DrawStripNow(DrawList& list, const Rect& area, const std::vector<Curve>& curves,
                  const StripLook& look);

}  // namespace seam
