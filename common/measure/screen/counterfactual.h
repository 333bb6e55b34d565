#pragma once
/// What an input did: the oracle's world with it, against the same world in which the player had
/// gone on as before.

#include <map>
#include <vector>

#include "common/measure/oracle.h"
#include "common/measure/screen/own.h"

namespace seam {

/// Inputs of all players by tick, as they were recorded.
using InputTape = std::map<int, std::map<std::int64_t, Input>>;
InputTape TapeOf(const Recording& recording);

/// A tick in which a player's input is another than in the tick before.
struct InputChange {
  int player = 0;
  std::int64_t tick = 0;
  Input before;
};

/// Not more than `count` of each player, evenly chosen, from `first` to `last`.
std::vector<InputChange> ChangesOf(const InputTape& tape, std::int64_t first, std::int64_t last,
                                   int count);

/// What a change does to the body that it moves most.
struct Effect {
  PartId id = -1;                         ///< -1: to none
  double radius = 0;                      ///< m; 0: the place alone counts, else the turn as well
  std::vector<Eigen::Vector3d> velocity;  ///< m/s, with less without; since the change's tick
};

/// Both worlds begin where the oracle is in the tick before the change, at rest in its contacts and
/// joints, and go on for `ticks`, without edits; in one of them the player's input stays what it
/// was. The body is looked for among the player's own, or among all if it has none by the scene;
/// it is the one whose velocity differs most, of the place if that reaches `speed_min` (m/s), else
/// of its turn, as the velocity of its farthest point.
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
  const RevisionHistory own_edits_;  // with the oracle's own edits
  OwnBodies* own_;
  InputTape tape_;
};

}  // namespace seam
