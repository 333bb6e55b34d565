#pragma once
/// seam-render as a function: what main does, callable from tests.

#include "render/options.h"

namespace seam {

/// Parses the command line and does what it says. Returns the exit status: 0, or 2 after one line
/// on stderr for an operator's mistake, in which case nothing was written.
int RenderMain(int argc, const char* const* argv);

/// A sequence of frames of one recording, or of several in step.
void RenderSequence(const RenderOptions& options);
/// One picture of one collision.
void RenderStrobe(const RenderOptions& options);
/// One HTML file of all views of some recordings.
void RenderReviewPage(const RenderOptions& options);
/// Frames of what the bus brings.
void RenderLive(const RenderOptions& options);

}  // namespace seam
