#pragma once
/// Draws the frames of a sequence in several processes.

#include <functional>

namespace seam {

/// Calls `draw` with 0 to `count - 1`, each number in the next free one of `processes` child
/// processes. A child is a fork: it inherits this process's memory, and its only results are files.
/// Calls `progress` in this process after each item with the number done.
///
/// Uses processes, not threads: OSMesa's contexts share one screen, and llvmpipe (Mesa 22.3,
/// `llvmpipe_flush_resource`) reads the unfinished work of all contexts without a lock, so two
/// threads that draw at a time can crash.
///
/// The children end with this process. Throws OperatorError with the message of the first child
/// that throws (the others stop), and when a child is killed.
void DrawInProcesses(int count, int processes, const std::function<void(int item)>& draw,
                     const std::function<void(int done)>& progress);

}  // namespace seam
