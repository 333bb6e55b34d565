#include "common/measure/screen/counterfactual.h"

#include <algorithm>

#include "common/measure/screen/path.h"
#include "common/physics/world.h"

namespace seam {
namespace {

/// Returns the last input that was recorded up to `tick`.
Input InputAt(const std::map<std::int64_t, Input>& inputs, std::int64_t tick) {
  const auto after = inputs.upper_bound(tick);
  return after == inputs.begin() ? Input() : std::prev(after)->second;
}

/// Sets a player's axes, and triggers the actions of buttons that go down.
void Press(World* world, int player, const Input& before, const Input& now) {
  world->SetInput(player, now);
  const int pressed = now.buttons & ~before.buttons;
  const auto& actions = world->scene().players[static_cast<std::size_t>(player)].actions;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if ((pressed >> actions[a].button) & 1) world->Act(player, static_cast<int>(a));
  }
}

Scene AtRate(Scene scene, int tick_hz) {
  scene.solver.tick_hz = tick_hz;
  return scene;
}

}  // namespace

InputTape TapeOf(const Recording& recording) {
  InputTape tape;
  for (const auto& [player, pieces] : recording.inputs) {
    for (const auto& [first_tick, piece] : pieces) {
      for (std::size_t i = 0; i < piece.drive.size(); ++i) {
        tape[player].try_emplace(first_tick + static_cast<std::int64_t>(i),
                                 Input{piece.drive[i], piece.lift[i], piece.buttons[i]});
      }
    }
  }
  return tape;
}

std::vector<InputChange> ChangesOf(const InputTape& tape, std::int64_t first, std::int64_t last,
                                   int count) {
  std::vector<InputChange> chosen;
  for (const auto& [player, inputs] : tape) {
    std::vector<InputChange> all;
    Input before;
    for (const auto& [tick, input] : inputs) {
      if (tick >= first && tick <= last && !(input == before)) {
        all.push_back({player, tick, before});
      }
      before = input;
    }
    const int found = static_cast<int>(all.size()), taken = std::min(count, found);
    for (int k = 0; k < taken; ++k) {
      chosen.push_back(all[static_cast<std::size_t>(k * found / taken)]);
    }
  }
  return chosen;
}

Counterfactual::Counterfactual(const Recording& recording, const Oracle& oracle,
                               const RevisionHistory& recorded, OwnBodies* own)
    : recording_(recording),
      oracle_(oracle),
      own_edits_(AtRate(recorded.At(0)->scene(), recording.room.tick_hz), oracle.edits),
      own_(own),
      tape_(TapeOf(recording)) {}

int Counterfactual::RevisionAt(std::int64_t tick) const {
  const auto row = static_cast<std::size_t>(tick - oracle_.first_tick);
  int edits = 0;
  for (const Oracle::RevisionSpan& span : oracle_.spans) {
    if (span.first_row <= row) edits = span.edits;
  }
  return edits;
}

Counterfactual::Run Counterfactual::Simulate(const InputChange& change, std::int64_t ticks,
                                             bool held) const {
  const std::int64_t from = change.tick - 1;
  Topology topology = own_edits_.At(RevisionAt(from))->topology;
  World world(topology);
  const auto& states = oracle_.ticks[static_cast<std::size_t>(from - oracle_.first_tick)];
  if (static_cast<int>(states.size()) != world.body_count()) return {};
  world.SetTick(from);
  for (int body = 0; body < world.body_count(); ++body) {
    world.Write(body, states[static_cast<std::size_t>(body)]);
  }
  const int players = static_cast<int>(world.scene().players.size());
  Run run;
  for (std::int64_t tick = change.tick; tick < change.tick + ticks; ++tick) {
    for (const auto& [player, inputs] : tape_) {
      if (player < 0 || player >= players) continue;
      const bool stays = held && player == change.player;
      const Input before = stays ? change.before : InputAt(inputs, tick - 1);
      Press(&world, player, before, stays ? change.before : InputAt(inputs, tick));
    }
    world.Step();
    std::vector<BodyState> now;
    for (int body = 0; body < world.body_count(); ++body) now.push_back(world.Read(body));
    run.push_back(std::move(now));
  }
  return run;
}

Effect Counterfactual::Of(const InputChange& change, std::int64_t ticks, double speed_min) const {
  const std::int64_t from = change.tick - 1;
  const auto row = static_cast<std::size_t>(from - oracle_.first_tick);
  if (from < oracle_.first_tick || row >= oracle_.ticks.size()) return {};
  const Run with = Simulate(change, ticks, false), without = Simulate(change, ticks, true);
  if (with.empty() || without.empty()) return {};
  const auto revision = own_edits_.At(RevisionAt(from));
  Extents extents(&own_edits_);
  const double hz = std::max(1, recording_.room.tick_hz);
  // Seats are edits of the recording; the oracle may have another number of edits.
  int edits = 0;
  for (const auto& [number, order] : recording_.edits) edits += order.tick <= from ? 1 : 0;
  const std::vector<PartId>& own = own_->ByScene(edits, change.player);
  const auto velocity = [&](std::size_t body, double radius) {
    std::vector<Eigen::Vector3d> all;
    DoublePose a(oracle_.ticks[row][body]), b = a;
    for (std::size_t t = 0; t < with.size(); ++t) {
      const DoublePose next_a(with[t][body]), next_b(without[t][body]);
      all.push_back((Between(a, next_a, radius) - Between(b, next_b, radius)) * hz);
      a = next_a;
      b = next_b;
    }
    return all;
  };
  Effect best;
  double most = speed_min;
  for (const bool turns : {false, true}) {
    for (std::size_t body = 0; body < revision->ids.size(); ++body) {
      const PartId id = revision->ids[body];
      const bool known = id < oracle_.inserted_from;
      if (!known || (!own.empty() && !std::binary_search(own.begin(), own.end(), id))) continue;
      const double radius = turns ? extents.Of(RevisionAt(from), id).radius() : 0;
      std::vector<Eigen::Vector3d> difference = velocity(body, radius);
      double speed = 0;
      for (const Eigen::Vector3d& d : difference) speed = std::max(speed, d.norm());
      if (speed < most) continue;
      most = speed;
      best = {id, radius, std::move(difference)};
    }
    if (best.id >= 0) break;
  }
  return best;
}

}  // namespace seam
