/// The truth simulated: one world, the recorded inputs, and the edits that came from outside.

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/measure/measure.h"
#include "common/measure/revisions.h"
#include "common/physics/world.h"
#include "common/sync/edit_order.h"

namespace seam {
namespace {

/// One player's recorded inputs by tick. Where pieces overlap they agree; the first one stands.
using InputTicks = std::map<std::int64_t, Input>;

InputTicks TicksOf(const std::map<std::int64_t, Inputs>& pieces) {
  InputTicks ticks;
  for (const auto& [first_tick, piece] : pieces) {
    for (std::size_t i = 0; i < piece.drive.size(); ++i) {
      ticks.try_emplace(first_tick + static_cast<std::int64_t>(i),
                        Input{piece.drive[i], piece.lift[i], piece.buttons[i]});
    }
  }
  return ticks;
}

/// Sets a player's axes for `tick`, if they were recorded, and does what its buttons going down do.
void Apply(World& world, int player, const InputTicks& inputs, std::int64_t tick) {
  const auto now = inputs.find(tick);
  if (now == inputs.end()) return;
  world.SetInput(player, now->second);
  const int before = now == inputs.begin() ? 0 : std::prev(now)->second.buttons;
  const int pressed = now->second.buttons & ~before;
  const auto& actions = world.scene().players[static_cast<std::size_t>(player)].actions;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if ((pressed >> actions[a].button) & 1) world.Act(player, static_cast<int>(a));
  }
}

std::vector<BodyState> ReadAll(const World& world) {
  std::vector<BodyState> states;
  states.reserve(static_cast<std::size_t>(world.body_count()));
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  return states;
}

/// Edits from outside, as recorded, said in the numbers of the oracle's own world.
class Outside {
 public:
  Outside(const Recording& recording, const Scene& scene)
      : recorded_(scene, recording), parts_(scene.parts.size()), joints_(scene.joints.size()) {
    for (const auto& [number, order] : recording.edits) {
      if (order.cause != static_cast<std::int8_t>(EditCause::kOutside)) continue;
      by_tick_[order.tick].push_back({number, ToEdit(order)});
    }
  }

  /// Those of the ticks up to this one that were not taken yet.
  std::vector<Edit> Take(std::int64_t tick, const Scene& now) {
    std::vector<Edit> edits;
    while (!by_tick_.empty() && by_tick_.begin()->first <= tick) {
      for (const auto& [number, edit] : by_tick_.begin()->second) {
        edits.push_back(edit);
        Translate(number, now, &edits.back());
      }
      by_tick_.erase(by_tick_.begin());
    }
    return edits;
  }

 private:
  PartId PartOf(const Scene& then, PartId part, const Scene& now) const {
    if (part < 0 || static_cast<std::size_t>(part) < parts_) return part;
    if (static_cast<std::size_t>(part) >= then.parts.size()) return -1;
    const std::string& name = then.parts[static_cast<std::size_t>(part)].name;
    for (std::size_t p = now.parts.size(); p-- > parts_;) {
      if (!now.parts[p].gone && now.parts[p].name == name) return now.parts[p].id;
    }
    return -1;
  }
  /// Joints that came have no lasting name: the one of that kind between the same parts.
  std::int32_t JointOf(const Scene& then, std::int32_t joint, const Scene& now) const {
    if (joint < 0 || static_cast<std::size_t>(joint) < joints_) return joint;
    if (static_cast<std::size_t>(joint) >= then.joints.size()) return -1;
    const Joint& wanted = then.joints[static_cast<std::size_t>(joint)];
    const PartId a = PartOf(then, wanted.a, now), b = PartOf(then, wanted.b, now);
    for (std::size_t j = now.joints.size(); j-- > joints_;) {
      const Joint& found = now.joints[j];
      if (found.gone || found.kind != wanted.kind) continue;
      if ((found.a == a && found.b == b) || (found.a == b && found.b == a)) {
        return static_cast<std::int32_t>(j);
      }
    }
    return -1;
  }
  /// Ids of what came at run time, into the oracle's own.
  void Translate(int number, const Scene& now, Edit* edit) const {
    const auto part = [&](PartId* id) {
      if (*id < 0 || static_cast<std::size_t>(*id) < parts_) return;
      *id = PartOf(recorded_.At(number)->scene(), *id, now);
    };
    std::visit(
        Overloaded{[&](BreakEdit& e) {
                     if (e.joint < 0 || static_cast<std::size_t>(e.joint) < joints_) return;
                     e.joint = JointOf(recorded_.At(number)->scene(), e.joint, now);
                   },
                   [&](BondEdit& e) {
                     part(&e.a);
                     part(&e.b);
                   },
                   [&](RemoveEdit& e) { part(&e.part); }, [&](FreeEdit& e) { part(&e.part); },
                   [&](PushEdit& e) { part(&e.part); }, [](auto&) {}},
        edit->what);
  }

  const RevisionHistory recorded_;
  const std::size_t parts_, joints_;  // that the scene has itself
  std::map<std::int64_t, std::vector<std::pair<int, Edit>>> by_tick_;
};

/// Applies edits to the world after `row` was read, or instead of it.
void Change(const std::vector<Edit>& edits, std::size_t row, World* world, Oracle* oracle) {
  if (edits.empty()) return;
  if (oracle->spans.empty()) oracle->Begin(0, SceneRevision(world->topology()), 0);
  oracle->edits.insert(oracle->edits.end(), edits.begin(), edits.end());
  if (!world->Apply(edits)) return;
  oracle->Begin(row, SceneRevision(world->topology()), static_cast<int>(oracle->edits.size()));
}

void RequireMemory(std::int64_t kept, const Recording& recording) {
  if (kept <= kOracleStatesMax) return;
  throw OperatorError("the session is too long for an oracle: " +
                      std::to_string(recording.last_tick) + " ticks with changing bodies");
}

}  // namespace

Oracle ComputeOracle(const Recording& recording, int nudged_body, float nudge) {
  Scene scene = ParseScene(recording.room.scene_text, recording.room.scene_name + ".toml");
  scene.solver.tick_hz = recording.room.tick_hz;
  World world(scene);
  if (nudged_body >= 0) {
    BodyState state = world.Read(nudged_body);
    // At least to the next float: 40 m from the origin a micrometre is lost in rounding.
    const float x = state.position.x();
    state.position.x() = std::max(x + nudge, std::nextafter(x, x + 1));
    world.Write(nudged_body, state, false);
  }
  Oracle oracle;
  for (int body = 0; body < world.body_count(); ++body) oracle.ids.push_back(world.id(body));
  const std::int64_t states = std::max(1, world.body_count());
  if (recording.last_tick > kOracleStatesMax / states) {
    throw OperatorError(
        "the session is too long for an oracle: " + std::to_string(recording.last_tick) +
        " ticks of " + std::to_string(states) + " bodies");
  }
  std::map<int, InputTicks> inputs;
  for (const auto& [player, pieces] : recording.inputs) {
    const bool known = player >= 0 && static_cast<std::size_t>(player) < scene.players.size();
    if (known) inputs[player] = TicksOf(pieces);
  }
  // In a recording with edits the views may be of other bodies than the oracle's from the start.
  if (!recording.edits.empty()) oracle.Begin(0, SceneRevision(world.topology()), 0);
  Outside outside(recording, scene);
  Change(outside.Take(0, world.scene()), 0, &world, &oracle);
  oracle.ticks.push_back(ReadAll(world));
  std::int64_t kept = 0;
  for (std::int64_t tick = 1; tick <= recording.last_tick; ++tick) {
    for (const auto& [player, ticks] : inputs) Apply(world, player, ticks, tick);
    world.Step();
    const std::size_t spans = oracle.spans.size(), row = oracle.ticks.size();
    Change(world.ProposeEdits(), row, &world, &oracle);
    Change(outside.Take(tick, world.scene()), row, &world, &oracle);
    kept += world.body_count();
    if (oracle.spans.size() > spans) {
      kept += static_cast<std::int64_t>(world.scene().parts.size());
    }
    RequireMemory(kept, recording);
    oracle.ticks.push_back(ReadAll(world));
  }
  oracle.Identify(recording, scene);
  return oracle;
}

}  // namespace seam
