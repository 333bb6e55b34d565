#pragma once
/// Effect of an input change: the oracle's world with the change, compared with the same world in
/// which the player's input stays as before.

#include <map>
#include <vector>

#include "common/measure/oracle.h"
#include "common/measure/screen/own.h"

namespace seam {

/// Recorded inputs by player, then by tick.
using InputTape = std::map<int, std::map<std::int64_t, Input>>;
/// Returns the inputs of all players of a recording.
InputTape TapeOf(const Recording& recording);

/// A tick in which a player's input differs from that of the tick before.
struct InputChange {
  int player = 0;
  std::int64_t tick = 0;
  Input before;
};

/// Returns at most `count` changes of each player, evenly chosen, from tick `first` to `last`.
std::vector<InputChange> ChangesOf(const InputTape& tape, std::int64_t first, std::int64_t last,
                                   int count);

/// Effect of an input change on the body that it moves most.
struct Effect {
  PartId id = -1;                         ///< -1: no body moves differently
  double radius = 0;                      ///< m; 0: only the position counts, else rotation as well
  std::vector<Eigen::Vector3d> velocity;  ///< m/s, difference by tick, since the change's tick
};

/// Computes effects with two worlds. Both begin with the oracle's states of the tick before the
/// change, without accumulated impulses of contacts and joints, and run for `ticks` without edits;
/// in one of them the player's input stays as it was. The body is chosen among the player's own, or
/// among all if the scene gives it none: the one with the greatest difference of velocity, of the
/// position if that reaches `speed_min` (m/s), else of the rotation at its farthest point.
class Counterfactual {
 public:
  Counterfactual(const Recording& recording, const Oracle& oracle, const RevisionHistory& recorded,
                 OwnBodies* own);
  Effect Of(const InputChange& change, std::int64_t ticks, double speed_min) const;

 private:
  using Run = std::vector<std::vector<BodyState>>;  // by tick, by body
  Run Simulate(const InputChange& change, std::int64_t ticks, bool held) const;
  int RevisionAt(std::int64_t tick) const;

  const Recording& recording_;
  const Oracle& oracle_;
  const RevisionHistory own_edits_;  // built from the oracle's own edits
  OwnBodies* own_;
  InputTape tape_;
};

}  // namespace seam
