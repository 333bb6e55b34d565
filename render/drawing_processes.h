#pragma once
/// Draws the frames of a sequence in several processes.

#include <functional>

namespace seam {

/// Calls `draw` with 0 to `count - 1`, each number in one of `processes` children of this one: the
/// next that is free. A child has what this process has made so far, and leaves nothing but files.
/// Here `progress` is called after each item with the number done.
///
/// Processes, not threads: OSMesa's contexts share one screen, and llvmpipe (Mesa 22.3,
/// `llvmpipe_flush_resource`) looks through the unfinished work of all of them without locking it:
/// two that draw at a time can crash.
///
/// The children end with this process. Throws OperatorError with the message of the first that
/// throws (the others stop), and when one is killed.
void DrawInProcesses(int count, int processes, const std::function<void(int item)>& draw,
                     const std::function<void(int done)>& progress);

}  // namespace seam
