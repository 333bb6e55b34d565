#pragma once
/// What a program with worlds in several threads does first.

namespace seam {

/// The engine fills a table of its own at the first contact of any world, without a lock. This
/// makes one, so that worlds may be stepped in several threads afterwards, each world in one at a
/// time.
void PrepareForThreads();

}  // namespace seam
