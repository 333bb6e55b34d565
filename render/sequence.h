#pragma once
/// Draws a page at many moments into a folder of PNG files, several frames at a time.

#include <functional>
#include <vector>

#include "render/canvas/font.h"
#include "render/frame.h"
#include "render/output.h"

namespace seam {

/// Greatest number of frames of one sequence: nine hours at 30 a second. A damaged log may claim
/// any tick.
constexpr int kFramesMax = 1000000;

/// Returns moments `1/fps` apart from `from_s` up to and including `to_s`, s. Throws OperatorError
/// for more than kFramesMax moments.
std::vector<double> FrameTimes(double from_s, double to_s, double fps);

/// Called after each frame with the number done.
using Progress = std::function<void(int done)>;

/// Writes one frame per moment. Each of `processes` processes has its own canvas and takes the next
/// free frame (DrawInProcesses; 1: this process). The files do not depend on the number. Throws
/// OperatorError when a frame cannot be written (a full disk), after all have stopped.
void WriteSequence(const Page& page, const Font& font, const std::vector<double>& times_s,
                   int processes, const OutputFolder& folder, const Progress& progress);

}  // namespace seam
