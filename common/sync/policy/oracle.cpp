/// Mode oracle: every peer simulates everything alone, from the scene's scripts.

#include <utility>

#include "common/scene/scene.h"
#include "common/sync/inputs/input_source.h"
#include "common/sync/policy/found_edits.h"
#include "common/sync/policy/policy.h"

namespace seam {
namespace {

class OracleMode : public Policy {
 public:
  const char* mode() const override { return "oracle"; }
  std::string about() const override { return "one world: the truth"; }
  bool Follows(const Roles&, int) const override { return true; }
  Simulators simulators() const override { return Simulators::kEveryone; }
  bool IsOracle() const override { return true; }
  std::unique_ptr<EditQueue> MakeEditQueue() const override { return MakeFoundEditQueue(); }
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
