#pragma once
/// What seam-render was asked to do, checked as far as flags alone can be.

#include <limits>
#include <string>
#include <vector>

namespace seam {

struct RenderOptions {
  std::vector<std::string> logs;
  std::string out;  ///< folder; a file for strobe
  bool compare = false, strobe = false, live = false, force = false;
  int fps = 30;
  int width_px = 1280, height_px = 720;
  bool size_given = false;
  double from_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the recording's own
  double to_s = std::numeric_limits<double>::quiet_NaN();
  bool peer_given = false;
  int peer = 0;        ///< kViewAll: all side by side
  std::string oracle;  ///< log made in mode oracle; "": computed
  int threads = 0;     ///< 0: as many as there are cores
  int every_ticks = 0;
  std::string lcm_url, room;
  double seconds = 0;  ///< live: at most this long; 0: until quiet
  std::string video;
  std::string fonts;
};

/// False when only help was wanted (printed to stdout). Throws OperatorError, one line, on a flag
/// that is unknown, malformed, or does not go with the others.
bool ParseRenderOptions(int argc, const char* const* argv, RenderOptions* options);

}  // namespace seam
