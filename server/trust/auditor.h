#pragma once
/// Audits told states by stepping them again, without a copy in the room's own world: a spare world
/// follows half a second behind the told states of some clients. A fifth of a second after one of
/// their mechanisms was put into it, it is compared with the state told for that tick.
///
///   accepted States -> NoteTold -> by mechanism: states of the last second
///   after a tick's sends: Work -> one tick of the spare world (SpareWorld)
///                              -> mechanisms told for that tick: compared, put anew
///                              -> gains -> SteadyGain -> Doubts, for the TrustLadder
///
/// A secret stream draws the clients, if not all can be followed, and the times between. It reads
/// the room's world and never changes it.

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "common/base/random.h"
#include "common/codec/messages.h"
#include "common/sync/audit/followed_step.h"
#include "common/sync/audit/spare_world.h"
#include "common/sync/audit/steady_gain.h"
#include "common/sync/replica.h"
#include "common/sync/table/mechanism_column.h"
#include "server/trust/doubt.h"
#include "server/trust/surroundings.h"
#include "server/trust/told_states.h"

namespace seam {

class Auditor {
 public:
  /// `replica` must outlive this. `seed`: no client may know it.
  Auditor(const Replica& replica, std::uint64_t seed);

  /// Takes accepted states of a player's client.
  void NoteTold(int player, const States& states);
  /// Call before an edit is applied: mechanisms that it moves are not compared across it.
  void NoteEdit(const Edit& edit);
  /// Call after each tick, when all is sent. Takes at most kStepsPerS of work a second.
  void Work();

  /// A doubt about a player's client.
  struct Found {
    int peer = 0, player = -1;
    Doubt doubt;
  };
  /// Returns the doubts since the last call.
  std::vector<Found> TakeFound() { return std::exchange(found_, {}); }
  /// Numbers since the start.
  struct Counts {
    std::int64_t compared = 0;  ///< mechanisms, once for each time that they were compared
    std::int64_t steps = 0;     ///< substeps of bodies
    double greatest = 0;        ///< SteadyGain::share of a mechanism
  };
  const Counts& counts() const { return counts_; }

  /// Work in a second, substeps of a body. Less finds lies later where many clients play.
  static constexpr std::int64_t kStepsPerS = 12000;
  /// The spare world is so far behind the room's, s: states and inputs come that late.
  static constexpr double kBehindS = 0.5;

 private:
  struct Track {
    int peer = 0, player = -1;
    int revision = 0;  // states of peers that lack an edit up to it do not count
    bool drawn = false;
    bool active = false;      // listed in active_
    ToldStates told;          // in the order of SpareWorld::bodies
    std::int64_t since = -1;  // tick from which it is in the spare world; -1: it is not
    std::int64_t put = -1;    // tick at which it was last put at told states; -1: not
    std::int64_t from = -1;   // tick from which it is compared
    std::int64_t due = 0;     // tick of the next comparison
    SteadyGain gain;
    FollowedStep step;             // of a character
    std::int64_t step_since = -1;  // tick from which its step is followed; -1: it is not
  };

  void Draw();
  void Build();
  void JumpTo(std::int64_t tick);
  void StepOnce();
  void Visit(int mechanism, std::int64_t tick);
  void PutTold(int mechanism, std::int64_t tick, bool anew);
  void PutStill(int mechanism, std::int64_t tick);
  void Leave(int mechanism);
  void Activate(int mechanism);
  void Compare(int mechanism, const ToldStates::Told& told, const std::optional<Gain>& gain);
  void LoseStep(int mechanism);
  bool Walks(int mechanism) const { return characters_[static_cast<std::size_t>(mechanism)] != 0; }
  void NoteLie(int mechanism, const ToldStates::Told& told);
  bool ToldInputs(int player, std::int64_t from, std::int64_t to) const;
  bool Knows(int mechanism, std::int64_t from, std::int64_t to) const;
  void Forget(int mechanism);
  void NoteRenumbered();
  int Seconds(double s) const;
  bool Asleep(int mechanism) const;
  bool Moves(int mechanism) const;

  const Replica& replica_;
  Random random_;
  MechanismColumn<Track> tracks_;
  EditHook renumbered_;
  Surroundings surroundings_;
  std::vector<std::size_t> place_;      // rebuilt at edits, by body: its place in its mechanism
  std::vector<std::size_t> size_;       // rebuilt at edits, by mechanism: number of bodies
  std::vector<char> characters_;        // rebuilt at edits, by mechanism: has an active character
  std::unique_ptr<SpareWorld> spare_;   // null: to be built
  std::vector<int> watched_;            // mechanisms of clients that moved at the last draw
  std::vector<int> active_;             // mechanisms that are told of, or in the spare world
  std::vector<int> players_;            // their clients'
  std::vector<char> driven_by_others_;  // rebuilt by Draw, by mechanism
  std::int64_t worked_ = -1, draw_at_ = 0;
  std::int64_t credit_ = 0;             // substeps of bodies
  std::vector<std::int64_t> noted_;     // tick of the newest doubt, by player
  std::vector<std::int64_t> followed_;  // tick of the newest draw, by peer
  std::vector<Found> found_;
  Counts counts_;
};

}  // namespace seam
