#include "common/measure/limit/held_inputs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "common/measure/limit/driven.h"
#include "common/measure/mean_square.h"
#include "common/measure/outside_edits.h"
#include "common/measure/recorded_inputs.h"
#include "common/measure/revisions.h"
#include "common/measure/screen/extent.h"
#include "common/physics/world.h"
#include "common/sync/method.h"

namespace seam {
namespace {

/// The best prediction that one player could have made for a later tick.
struct Guess {
  int player = 0;
  std::int64_t tick = 0;
  std::vector<BodyState> states;  // by body; empty: equals the truth, no input was held wrongly
};

std::vector<BodyState> ReadAll(const World& world) {
  std::vector<BodyState> states;
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  return states;
}

/// Simulates the truth, and from its barriers every player's predictions.
class Guesser {
 public:
  Guesser(const Recording& recording, const Scene& scene, KnownInputs known, int every)
      : every_(every), world_(scene), inputs_(recording, scene), known_(std::move(known)) {
    LookAgain();
    for (std::int64_t tick = every; tick <= recording.last_tick; tick += every) {
      for (const int player : inputs_.players()) {
        const std::int64_t from = std::min(Oldest(player, tick), tick - 1) / every * every;
        due_[from].push_back({player, tick, {}});
      }
    }
  }

  /// Takes a barrier where one is due, and makes the predictions that begin here.
  void GuessAll() {
    if (world_.tick() % every_ != 0) return;
    const WorldSnapshot now = world_.Barrier();
    const auto due = due_.find(world_.tick());
    if (due == due_.end()) return;
    bool away = false;
    for (Guess& guess : due->second) {
      if (!KnowsAll(guess)) {
        GoBackTo(now);
        MakeGuess(&guess);
        away = true;
      }
      guesses_.push_back(std::move(guess));
    }
    due_.erase(due);
    if (away) GoBackTo(now);
  }

  /// Steps to the next tick, and compares the predictions for it.
  void Step() {
    const std::int64_t tick = world_.tick() + 1;
    for (const int player : inputs_.players()) inputs_.Apply(&world_, player, tick);
    world_.Step();
    for (const Guess& guess : guesses_) {
      if (guess.tick == tick) Compare(guess);
    }
    const auto done = [tick](const Guess& guess) { return guess.tick <= tick; };
    guesses_.erase(std::remove_if(guesses_.begin(), guesses_.end(), done), guesses_.end());
  }

  void Apply(const std::vector<Edit>& edits) {
    if (edits.empty() || !world_.Apply(edits)) return;
    guesses_.clear();  // their bodies no longer exist
    LookAgain();
  }

  const World& world() const { return world_; }
  std::optional<double> rms() const { return apart_.Root(); }

 private:
  /// Updates ownership and extents after the bodies changed.
  void LookAgain() {
    for (const int player : inputs_.players()) own_[player] = DrivenBy(world_, player);
    extents_.clear();
    for (const Assembly& assembly : world_.composition().assemblies) {
      if (!assembly.anchored) extents_.emplace_back(world_.scene(), assembly);
    }
  }
  void GoBackTo(const WorldSnapshot& snapshot) {
    const Status back = world_.Restore(snapshot);
    SEAM_ASSERT(back.ok());
    for (const int player : inputs_.players()) inputs_.Hold(&world_, player, snapshot.tick);
  }

  /// The newest tick of `other`'s inputs that is known where `player` shows `tick`.
  std::int64_t Known(int other, int player, std::int64_t tick) const {
    const auto known = known_.find({other, player});
    return known == known_.end() ? tick : known->second[static_cast<std::size_t>(tick)];
  }
  /// Returns the tick up to which the player knows all inputs; at least 0, since tick 0 is known.
  std::int64_t Oldest(int player, std::int64_t tick) const {
    std::int64_t oldest = tick;
    for (const int other : inputs_.players()) {
      oldest = std::min(oldest, Known(other, player, tick));
    }
    return std::max<std::int64_t>(0, oldest);
  }
  bool KnowsAll(const Guess& guess) const {
    for (const int other : inputs_.players()) {
      if (!inputs_.Holds(other, Known(other, guess.player, guess.tick), guess.tick)) return false;
    }
    return true;
  }

  /// Predicts from the present world, with barriers where the truth has them.
  void MakeGuess(Guess* guess) {
    for (const int other : inputs_.players()) {
      inputs_.Hold(&world_, other,
                   std::min(world_.tick(), Known(other, guess->player, guess->tick)));
    }
    while (world_.tick() < guess->tick) {
      const std::int64_t tick = world_.tick() + 1;
      for (const int other : inputs_.players()) {
        if (tick <= Known(other, guess->player, guess->tick)) inputs_.Apply(&world_, other, tick);
      }
      world_.Step();
      if (tick < guess->tick && tick % every_ == 0) world_.Barrier();
    }
    guess->states = ReadAll(world_);
  }

  void Compare(const Guess& guess) {
    const std::vector<bool>& own = own_[guess.player];
    for (int body = 0; body < world_.body_count(); ++body) {
      const auto b = static_cast<std::size_t>(body);
      if (own[b]) continue;
      const double apart = guess.states.empty()
                               ? 0
                               : extents_[b].Displacement(DoublePose(guess.states[b]),
                                                          DoublePose(world_.Read(body)));
      apart_.Add(apart * apart);
    }
  }

  const int every_;
  World world_;
  const RecordedInputs inputs_;
  const KnownInputs known_;
  std::map<std::int64_t, std::vector<Guess>> due_;  // by the tick of their start
  std::map<int, std::vector<bool>> own_;            // by player, by body
  std::vector<Extent> extents_;                     // by body
  std::vector<Guess> guesses_;
  MeanSquare apart_;
};

}  // namespace

std::optional<double> HeldInputsError(const Recording& recording, int every) {
  SEAM_ASSERT(every >= 1);
  if (PolicyOf(recording.room).IsOracle()) return std::nullopt;
  RequireBeginning(recording);
  Scene scene = RecordedScene(recording.room);
  scene.solver.tick_hz = recording.room.tick_hz;
  const KnownInputs known = FindKnownInputs(recording);
  if (known.empty()) return std::nullopt;
  OutsideEdits outside(scene);
  outside.Add(recording);
  Guesser guesser(recording, scene, known, every);
  guesser.Apply(outside.Take(0, guesser.world().scene()));
  for (std::int64_t tick = 1; tick <= recording.last_tick; ++tick) {
    guesser.GuessAll();
    guesser.Step();
    guesser.Apply(guesser.world().ProposeEdits());
    guesser.Apply(outside.Take(tick, guesser.world().scene()));
  }
  return guesser.rms();
}

}  // namespace seam
