#pragma once
/// The oracle of a recording that may still grow: one world, the recorded inputs, and the edits
/// with an external cause.

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "common/measure/oracle.h"
#include "common/measure/outside_edits.h"
#include "common/measure/recorded_inputs.h"
#include "common/physics/world.h"
#include "common/record/recording.h"

namespace seam {

class GrowingOracle {
 public:
  /// Begins at tick 0 with the room's scene. Throws OperatorError for a scene that does not parse.
  GrowingOracle(const Room& room, const OracleOptions& options);
  GrowingOracle(const GrowingOracle&) = delete;
  GrowingOracle& operator=(const GrowingOracle&) = delete;

  /// Takes over the inputs and edits that `recording` has and that are not known yet. Inputs that
  /// it has forgotten since then stay known. To be called once before the first tick.
  void Hear(const Recording& recording);
  /// Simulates the next tick, with what is known of its inputs and edits. What becomes known of it
  /// later has no effect, but an edit, which is applied then.
  void Step();
  /// Forgets the poses of all ticks before this one.
  void Forget(std::int64_t before_tick);

  /// The tick that was simulated last.
  std::int64_t tick() const { return tick_; }
  const World& world() const { return world_; }
  const Oracle& oracle() const { return oracle_; }
  /// Matches the parts inserted at run time with those of the recording (Oracle::Identify).
  void Identify(const Recording& recording) { oracle_.Identify(recording, scene_); }
  /// Returns the oracle. To be called once, at the end.
  Oracle Take() { return std::move(oracle_); }

 private:
  bool Change(const std::vector<Edit>& edits, std::size_t row);

  bool TakeOutside(std::size_t row);

  const OracleOptions options_;
  const Scene scene_;  // without any edit
  World world_;
  RecordedInputs inputs_;
  OutsideEdits outside_;
  Oracle oracle_;
  const bool watch_;  // for the first contact of two players
  const std::map<PartId, int> owners_;
  std::int64_t tick_ = 0, forgotten_ = 0;
};

}  // namespace seam
