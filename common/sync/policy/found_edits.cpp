#include "common/sync/policy/found_edits.h"

#include <map>
#include <vector>

#include "common/sync/edits/edit_order.h"

namespace seam {
namespace {

class FoundEditQueue : public EditQueue {
 public:
  bool Take(const EditOrder& order, int) override {
    const Edit edit = ToEdit(order);
    if (edit.cause == EditCause::kOutside) outside_[order.tick].push_back(edit);
    return true;
  }
  bool TakeFound(const Edit& edit, std::int64_t tick) override {
    Push(edit, tick);
    return true;
  }
  void AfterStep(std::int64_t tick) override {
    while (!outside_.empty() && outside_.begin()->first <= tick) {
      for (const Edit& edit : outside_.begin()->second) Push(edit, tick);
      outside_.erase(outside_.begin());
    }
  }

  std::size_t size() const override {
    std::size_t sum = EditQueue::size();
    for (const auto& [tick, edits] : outside_) sum += edits.size();
    return sum;
  }

 private:
  std::map<std::int64_t, std::vector<Edit>> outside_;  // by tick
};

}  // namespace

std::unique_ptr<EditQueue> MakeFoundEditQueue() { return std::make_unique<FoundEditQueue>(); }

}  // namespace seam
