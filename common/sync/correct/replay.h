#pragma once
/// Going back to where a message is from, and stepping again from there.
///
///   barrier      t1 message                      now
///   --|-----------o-----|-----------|-----------|--o     all that came between two steps: one
///     restore --> put in ... step, step, step ...        replay, from the oldest t1
///
/// The authority's states are put in at every tick of which one is known, so what was heard before
/// is not forgotten. Our own bodies are stepped again, too: a collision that was otherwise than we
/// thought was so for both. Only where bodies of several authorities press against each other
/// without a blow, ours follow their history and the others' are corrected by a share: there each
/// peer would correct towards what the other corrected.

#include <cstdint>
#include <deque>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/display.h"
#include "common/sync/input_track.h"
#include "common/sync/mode.h"
#include "common/sync/roles.h"

namespace seam {

/// Does nothing unless the room's rule resimulates.
class Replay {
 public:
  /// All must outlive this. `inputs`: by player.
  Replay(const SyncConfig& config, World& world, const Roles& roles, BodyMemory& memory,
         Display& display, const std::vector<InputTrack>& inputs);

  /// Asks for a replay from `tick`, of which a state of `body` came; none is needed if it agrees
  /// with our past. False: there is no way back to that tick.
  bool Ask(int body, std::int64_t tick);
  /// Goes back to the oldest tick asked for and steps again to now.
  void Run();
  /// After a step to a tick of which States are sent: makes it one to go back to.
  void TakeBarrier();
  /// This peer did a player's action (index) before the step to `tick`; a replay repeats it.
  void NoteAction(std::int64_t tick, int player, int action);
  /// There is no way back to before now: a body is new, or the bodies have changed.
  void Forget();

 private:
  struct Action {
    std::int64_t tick = 0;
    int player = 0, action = 0;
  };

  void FindPressed(std::int64_t from);
  bool FollowsHistory(int body, std::int64_t tick) const;
  void PutIn();
  void StepAgain();

  const SyncConfig& config_;
  World& world_;
  const Roles& roles_;
  BodyMemory& memory_;
  Display& display_;
  const std::vector<InputTrack>& inputs_;
  std::deque<WorldSnapshot> barriers_;  // ascending
  std::deque<Action> actions_;          // since the first barrier
  std::int64_t from_ = -1;              // oldest tick asked for, -1 none
  std::vector<bool> pressed_;           // by mechanism, of the replay that runs
};

}  // namespace seam
