#pragma once
/// Edits that physics found and this peer is to propose: each edit once, and again only when it was
/// not ordered for a while.

#include <cstdint>
#include <map>
#include <vector>

#include "common/topology/edit.h"

namespace seam {

/// An edit, and the tick after which physics found it.
struct FoundEdit {
  Edit edit;
  std::int64_t tick = 0;
};

class ProposalQueue {
 public:
  explicit ProposalQueue(int tick_hz);

  /// Queues an edit found at `tick`, unless one of the same kind, joint and parts was queued within
  /// the last 0.5 s. Returns whether it was.
  bool Add(Edit edit, std::int64_t tick);
  /// An edit of this key was ordered: what is found from now on is another.
  void Forget(const EditKey& key) { proposed_.erase(key); }
  /// All that was queued since the last call, in its order.
  std::vector<FoundEdit> Take();
  /// Edits that it remembers to have been queued.
  std::size_t remembered() const { return proposed_.size(); }

 private:
  std::int64_t again_ticks_;
  std::map<EditKey, std::int64_t> proposed_;  // when last
  std::vector<FoundEdit> waiting_;
};

}  // namespace seam
