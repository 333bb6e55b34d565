#include "common/sync/proposal_queue.h"

#include <utility>

#include "common/base/state_archive.h"

namespace seam {
namespace {

/// A proposal without an order is repeated after this, s.
constexpr double kProposeAgain = 0.5;
/// Most proposals remembered; beyond it all are forgotten, and some are repeated too early.
constexpr std::size_t kProposedMax = 4096;

}  // namespace

ProposalQueue::ProposalQueue(int tick_hz)
    : again_ticks_(static_cast<std::int64_t>(kProposeAgain * tick_hz)) {}

bool ProposalQueue::Add(Edit edit, std::int64_t tick) {
  const EditKey key = KeyOf(edit);
  const auto said = proposed_.find(key);
  if (said != proposed_.end() && tick - said->second < again_ticks_) return false;
  if (proposed_.size() > kProposedMax) proposed_.clear();
  proposed_[key] = tick;
  waiting_.push_back({std::move(edit), tick});
  return true;
}

std::vector<FoundEdit> ProposalQueue::Take() { return std::exchange(waiting_, {}); }

void ProposalQueue::Persist(StateArchive& a) {
  a.Entries(
      &proposed_, kProposedMax + 1,
      [&](EditKey* key) {
        for (std::int32_t& each : *key) a.Int(&each, INT32_MIN, INT32_MAX);
      },
      [&](std::int64_t* tick) { a.Tick(tick); });
}

}  // namespace seam
