#pragma once
/// seam-render as a function, callable from tests.

#include "render/options.h"

namespace seam {

/// Parses the command line and runs the command. Returns the exit status: 0, or 2 after one line on
/// stderr for an operator's mistake, in which case nothing was written.
int RenderMain(int argc, const char* const* argv);

/// Draws a sequence of frames of one recording, or of several side by side.
void RenderSequence(const RenderOptions& options);
/// Draws one picture of one collision.
void RenderStrobe(const RenderOptions& options);
/// Writes one HTML file with all views of the recordings.
void RenderReviewPage(const RenderOptions& options);
/// Draws frames of a session on the bus while it runs.
void RenderLive(const RenderOptions& options);

}  // namespace seam
