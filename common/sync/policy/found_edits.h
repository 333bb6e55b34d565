#pragma once
/// Edits of modes in which every peer applies by itself what its physics finds
/// (Policy::AppliesFoundEdits).

#include <memory>

#include "common/sync/edits/edit_queue.h"

namespace seam {

/// Makes a queue that takes edits of physics at once. Of the server's orders it takes those from
/// outside, each after the step to its tick, behind what physics found in that step.
std::unique_ptr<EditQueue> MakeFoundEditQueue();

}  // namespace seam
