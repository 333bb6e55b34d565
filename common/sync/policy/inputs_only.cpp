/// Modes lockstep and ggpo: every peer simulates everything, and peers send each other inputs
/// alone. In lockstep a tick waits for the inputs of all players. In ggpo (named after Cannon's
/// library) clients go on with held inputs for a few ticks, and go back when an input differs. The
/// server is a peer without a player, and steps complete ticks only, as GGPO's spectators do.

#include "common/sync/policy/found_edits.h"
#include "common/sync/policy/policy.h"

namespace seam {
namespace {

/// Input delay where the scene has none, ticks. In lockstep: players 130 ms apart need not wait. In
/// ggpo: its guide advises two or three frames.
constexpr int kLockstepDelay = 8, kGgpoDelay = 3;
/// Most ticks that a client of mode ggpo predicts: GGPO's MAX_PREDICTION_FRAMES. More lets it go on
/// over longer ways, and stepping again costs as much more.
constexpr std::int64_t kPredictMost = 8;

class InputsOnlyMode : public Policy {
 public:
  bool Follows(const Roles&, int) const override { return true; }
  Simulators simulators() const override { return Simulators::kEveryone; }
  bool InputsOnly() const override { return true; }
  bool StampsInputs(int) const override { return true; }
  /// A client that joins begins at one, and all other worlds must be the same as its own.
  bool TakesBarriers(int) const override { return true; }
  bool BarriersAfterEdits(int) const override { return true; }
  bool CopiesAgree() const override { return true; }
  bool TrustsSleep() const override { return true; }
  bool ShowsPast(int) const override { return false; }
};

class Lockstep : public InputsOnlyMode {
 public:
  explicit Lockstep(bool adaptive) : adaptive_(adaptive) {}

  const char* mode() const override { return adaptive_ ? "lockstep-adaptive" : "lockstep"; }
  std::string about() const override { return "waits for all inputs"; }
  std::int64_t MostAhead(int) const override { return 0; }
  bool AppliesFoundEdits() const override { return true; }
  std::unique_ptr<EditQueue> MakeEditQueue() const override { return MakeFoundEditQueue(); }
  int InputDelay(int of_scene) const override { return of_scene > 0 ? of_scene : kLockstepDelay; }
  bool AdaptsInputDelay() const override { return adaptive_; }

 private:
  const bool adaptive_;
};

class Ggpo : public InputsOnlyMode {
 public:
  const char* mode() const override { return "ggpo"; }
  std::string about() const override { return "rollback of inputs only"; }
  bool GoesBack(int self) const override { return self > 0; }
  std::int64_t MostAhead(int self) const override { return self > 0 ? kPredictMost : 0; }
  int InputDelay(int of_scene) const override { return of_scene > 0 ? of_scene : kGgpoDelay; }
};

}  // namespace

const Policy& LockstepPolicy(bool adaptive) {
  static const Lockstep fixed(false), adapts(true);
  return adaptive ? adapts : fixed;
}

const Policy& GgpoPolicy() {
  static const Ggpo policy;
  return policy;
}

}  // namespace seam
