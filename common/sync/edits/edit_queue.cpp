#include "common/sync/edits/edit_queue.h"

#include <algorithm>
#include <utility>

#include "common/sync/edits/edit_order.h"

namespace seam {

bool EditQueue::Take(const EditOrder& order, int revision) {
  if (order.number != revision + static_cast<int>(queued_.size())) return false;
  const std::int64_t after = queued_.empty() ? order.tick : queued_.back().tick;
  Push(ToEdit(order), std::max(after, order.tick));
  return true;
}

bool EditQueue::TakeFound(const Edit&, std::int64_t) { return false; }

void EditQueue::AfterStep(std::int64_t) {}

QueuedEdit EditQueue::Pop() {
  QueuedEdit next = std::move(queued_.front());
  queued_.erase(queued_.begin());
  return next;
}

void EditQueue::Hurry(std::int64_t tick) {
  for (QueuedEdit& edit : queued_) edit.tick = std::min(edit.tick, tick);
}

}  // namespace seam
