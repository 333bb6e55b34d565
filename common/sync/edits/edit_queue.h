#pragma once
/// Edits that a peer is to apply, in the order in which it applies them.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/topology/edit.h"

namespace seam {

/// An edit to be applied after a tick.
struct QueuedEdit {
  Edit edit;
  std::int64_t tick = 0;
};

/// Takes the server's orders by their numbers.
class EditQueue {
 public:
  EditQueue() = default;
  EditQueue(const EditQueue&) = delete;
  EditQueue& operator=(const EditQueue&) = delete;
  virtual ~EditQueue() = default;

  /// Takes an order of the server. `revision`: number of edits applied so far. Returns false, and
  /// ignores the order, if it is not the next one.
  virtual bool Take(const EditOrder& order, int revision);
  /// Takes an edit that physics found in the step to `tick`. Returns false if it must be proposed
  /// to the server instead.
  virtual bool TakeFound(const Edit& edit, std::int64_t tick);
  /// Call after the step to `tick`, after TakeFound.
  virtual void AfterStep(std::int64_t tick);

  bool empty() const { return queued_.empty(); }
  /// Number of edits that were taken and not yet applied.
  virtual std::size_t size() const { return queued_.size(); }
  /// The next edit. Requires that there is one.
  const QueuedEdit& front() const { return queued_.front(); }
  QueuedEdit Pop();
  /// Makes all edits due at `tick` at the latest.
  void Hurry(std::int64_t tick);

 protected:
  void Push(const Edit& edit, std::int64_t tick) { queued_.push_back({edit, tick}); }

 private:
  std::vector<QueuedEdit> queued_;  // not yet applied; ticks ascend
};

}  // namespace seam
