#pragma once
/// Initialisation for programs that step worlds in several threads.

namespace seam {

/// Makes a contact, at which the engine fills a global table without a lock. Call once before
/// worlds are stepped in several threads; each world may be in one thread at a time.
void PrepareForThreads();

}  // namespace seam
