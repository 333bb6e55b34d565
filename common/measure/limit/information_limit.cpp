#include "common/measure/limit/information_limit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "common/measure/limit/driven.h"
#include "common/measure/mean_square.h"
#include "common/measure/outside_edits.h"
#include "common/measure/recorded_inputs.h"
#include "common/measure/screen/extent.h"
#include "common/physics/world.h"
#include "common/sync/mode.h"

namespace seam {
namespace {

using Ages = std::map<std::pair<int, int>, std::int64_t>;

/// What one player could have shown at a tick to come.
struct Guess {
  int player = 0;
  std::int64_t tick = 0;
  std::vector<BodyState> states;  // by body
};

std::vector<BodyState> ReadAll(const World& world) {
  std::vector<BodyState> states;
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  return states;
}

/// The truth, and from each of its barriers every player's guess.
class Guesser {
 public:
  Guesser(const Recording& recording, const Scene& scene, Ages ages)
      : world_(scene), inputs_(recording, scene), ages_(std::move(ages)) {
    LookAgain();
  }

  /// From the world as it is, which is left as it was.
  void GuessAll() {
    const WorldSnapshot now = world_.Barrier();
    for (const int player : inputs_.players()) GuessOf(player, now);
    GoBackTo(now);
  }

  /// Makes the next tick, and compares what was guessed of it.
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
    guesses_.clear();  // of other bodies
    LookAgain();
  }

  const World& world() const { return world_; }
  std::optional<double> rms() const { return apart_.Root(); }

 private:
  /// At what the bodies are made of.
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

  void GuessOf(int player, const WorldSnapshot& from) {
    std::int64_t oldest = 0;
    for (const int other : inputs_.players()) {
      const auto age = ages_.find({other, player});
      if (age != ages_.end()) oldest = std::max(oldest, age->second);
    }
    if (oldest == 0) return;  // it knows all
    GoBackTo(from);
    Guess guess{player, from.tick + oldest, {}};
    while (world_.tick() < guess.tick) {
      const std::int64_t tick = world_.tick() + 1;
      for (const int other : inputs_.players()) {
        const auto age = ages_.find({other, player});
        const std::int64_t known = age == ages_.end() ? guess.tick : guess.tick - age->second;
        if (tick <= known) inputs_.Apply(&world_, other, tick);
      }
      world_.Step();
    }
    guess.states = ReadAll(world_);
    guesses_.push_back(std::move(guess));
  }

  void Compare(const Guess& guess) {
    const std::vector<bool>& own = own_[guess.player];
    for (int body = 0; body < world_.body_count(); ++body) {
      const auto b = static_cast<std::size_t>(body);
      if (own[b]) continue;
      const double apart = extents_[b].Displacement(Pose(guess.states[b]), Pose(world_.Read(body)));
      apart_.Add(apart * apart);
    }
  }

  World world_;
  const RecordedInputs inputs_;
  const Ages ages_;
  std::map<int, std::vector<bool>> own_;  // by player, by body
  std::vector<Extent> extents_;           // by body
  std::vector<Guess> guesses_;
  MeanSquare apart_;
};

}  // namespace

std::optional<double> InformationLimit(const Recording& recording, int every) {
  SEAM_ASSERT(every >= 1);
  if (FindMode(recording.room.mode) == Mode::kOracle) return std::nullopt;
  Scene scene = ParseScene(recording.room.scene_text, recording.room.scene_name + ".toml");
  scene.solver.tick_hz = recording.room.tick_hz;
  const Ages ages = FindInputAges(recording);
  if (ages.empty()) return std::nullopt;
  OutsideEdits outside(recording, scene);
  Guesser guesser(recording, scene, ages);
  guesser.Apply(outside.Take(0, guesser.world().scene()));
  for (std::int64_t tick = 1; tick <= recording.last_tick; ++tick) {
    if ((tick - 1) % every == 0) guesser.GuessAll();
    guesser.Step();
    guesser.Apply(guesser.world().ProposeEdits());
    guesser.Apply(outside.Take(tick, guesser.world().scene()));
  }
  return guesser.rms();
}

}  // namespace seam
