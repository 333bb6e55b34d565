#pragma once
/// Queue of edits found by physics for this peer to propose. Each edit is proposed once, and again
/// only if it was not ordered for a while.

#include <cstdint>
#include <map>
#include <vector>

#include "common/topology/edit.h"

namespace seam {

class StateArchive;

/// An edit, and the tick after which physics found it.
struct FoundEdit {
  Edit edit;
  std::int64_t tick = 0;
};

class ProposalQueue {
 public:
  explicit ProposalQueue(int tick_hz);

  /// Queues an edit found at `tick`, unless one of the same kind, joint and parts was queued within
  /// the last 0.5 s. Returns true if it was queued.
  bool Add(Edit edit, std::int64_t tick);
  /// Call when an edit of this key was ordered: a later find is a new edit.
  void Forget(const EditKey& key) { proposed_.erase(key); }
  /// Returns the edits queued since the last call, in order.
  std::vector<FoundEdit> Take();
  /// Requires that the queued edits have been taken.
  void Persist(StateArchive& a);
  /// Number of edits remembered as queued.
  std::size_t remembered() const { return proposed_.size(); }

 private:
  std::int64_t again_ticks_;
  std::map<EditKey, std::int64_t> proposed_;  // tick of the last queueing
  std::vector<FoundEdit> waiting_;
};

}  // namespace seam
