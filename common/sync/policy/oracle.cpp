/// Mode oracle: every peer simulates everything alone, from the scene's scripts.

#include <map>
#include <utility>

#include "common/scene/scene.h"
#include "common/sync/edits/edit_order.h"
#include "common/sync/inputs/input_source.h"
#include "common/sync/policy/policy.h"

namespace seam {
namespace {

/// Takes edits that physics finds at once. Of the server's orders it takes those from outside, each
/// after the step to its tick, behind what physics found in that step.
class OracleEditQueue : public EditQueue {
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

class OracleMode : public Policy {
 public:
  const char* mode() const override { return "oracle"; }
  std::string about() const override { return "one world: the truth"; }
  bool Follows(const Roles&, int) const override { return true; }
  Simulators simulators() const override { return Simulators::kEveryone; }
  bool IsOracle() const override { return true; }
  std::unique_ptr<EditQueue> MakeEditQueue() const override {
    return std::make_unique<OracleEditQueue>();
  }
  bool StampsInputs(int) const override { return true; }

  std::vector<Inputs> KnownInputs(const Scene& scene, std::int64_t tick, int delay) const override {
    std::vector<Inputs> all;
    for (int player = 0; player < static_cast<int>(scene.players.size()); ++player) {
      const Input in = ScriptedInput(scene, player, tick - delay);
      Inputs inputs;
      inputs.player = player;
      inputs.first_tick = tick;
      inputs.drive.push_back(in.drive);
      inputs.lift.push_back(in.lift);
      inputs.buttons.push_back(in.buttons);
      all.push_back(std::move(inputs));
    }
    return all;
  }
};

}  // namespace

const Policy& OraclePolicy() {
  static const OracleMode policy;
  return policy;
}

}  // namespace seam
