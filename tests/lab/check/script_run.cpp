/// seam-lab check: runs the scripts of a scene, without players and network.

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "common/physics/part_places.h"
#include "common/scene/lcm/lcm_tables.h"
#include "common/scene/part_rules.h"
#include "server/rules/rules.h"
#include "server/rules/script_room.h"
#include "server/rules/seats.h"
#include "server/rules/triggers.h"
#include "tests/lab/check/script_check.h"

namespace seam {
namespace {

/// Most calls of a callback for pairs of parts, and parts tried for one trigger: enough for every
/// name that a script compares with, few enough for a second.
constexpr std::size_t kPairsMost = 200, kPartsMost = 8;

/// Edits asked for by rules and scripts, checked against the world as a server's.
class DryCommands : public RoomCommands {
 public:
  explicit DryCommands(World& world) : world_(world) {}

  void RemovePart(PartId part) override { Ask(Edit(RemoveEdit{part}, EditCause::kOutside)); }
  void BreakJoint(int joint) override { Ask(Edit(BreakEdit{joint}, EditCause::kOutside)); }
  void Bond(PartId a, PartId b, float strength) override {
    Ask(Edit(BondAsTheyAre(world_, a, b, strength), EditCause::kOutside));
  }
  void Push(PartId part, const Vec2& impulse) override {
    Ask(Edit(PushEdit{part, impulse}, EditCause::kOutside));
  }
  void Limp(PartId part, float seconds) override {
    Ask(Edit(PushEdit{part, Vec2(0, 0), 0, seconds}, EditCause::kOutside));
  }
  void LeaveSeat(int seat) override {
    for (const Edit& edit : seam::LeaveSeat(world_, seat)) Ask(edit);
  }
  void Blast(const Vec2& centre, float radius, float speed, float impulse) override {
    Ask(Edit(BlastEdit{centre, radius, speed, impulse}, EditCause::kOutside));
  }
  void Insert(const std::string& text) override {
    Ask(Edit(InsertEdit{text}, EditCause::kOutside));
  }
  void Say(const Event&) override {}
  void Warn(const std::string&) override {}
  bool Present(int) const override { return true; }
  Input ReadInput(int) const override { return {}; }

  /// Applies what was asked for. `removals`: else what is removed stays, so that each callback
  /// finds the world of the scene.
  void Apply(bool removals) {
    for (const Edit& edit : std::exchange(asked_, {})) {
      const bool removes = edit.As<RemoveEdit>() != nullptr || edit.As<BreakEdit>() != nullptr;
      if (removes && !removals) continue;
      if (world_.topology().Validate(edit).ok()) world_.Apply({edit});
    }
  }

 private:
  void Ask(const Edit& edit) {
    const Status status = world_.topology().Validate(edit);
    if (!status.ok()) throw ScriptRefusal(status.why());
    asked_.push_back(edit);
  }

  World& world_;
  std::vector<Edit> asked_;
};

Scene WithoutScripts(Scene scene) {
  scene.scripts = FeatureList<ScriptSource>();
  return scene;
}

class DryRoom {
 public:
  DryRoom(const Scene& scene, std::vector<Finding>* findings)
      : scene_(scene),
        world_(WithoutScripts(scene)),
        commands_(world_),
        rules_(world_, 1, commands_),
        host_(rules_),
        triggers_(scene.triggers),
        findings_(findings) {
    world_.WatchTouches();
    for (const ScriptSource& source : scene.scripts) {
      scripts_.push_back(std::make_unique<Script>(source, kFile, 1, host_));
      lines_.push_back(source.line);
      told_.push_back(false);
    }
    Tell("");
  }

  ScriptHost& host() { return host_; }
  const Script& script(std::size_t index) const { return *scripts_[index]; }

  void LiveASecond() {
    for (int tick = 0; tick < scene_.solver.tick_hz; ++tick) {
      world_.Step();
      rules_.AfterTick();
      Begin();
      if (tick == 0) {
        for (const Player& player : scene_.players) {
          Each([&](Script& s) { s.OnJoin(player.name); });
        }
      }
      for (const PartTouch& touch : world_.begun_touches()) {
        Each([&](Script& s) { s.OnTouch(NameOf(touch.a), NameOf(touch.b)); });
      }
      RunTriggers();
      EndTick(true);
    }
  }

  void CallEachCallback() {
    for (const Trigger& trigger : scene_.triggers) {
      const std::size_t parts = trigger.once ? 1 : kPartsMost;
      for (std::size_t i = 0; i < std::min(parts, trigger.parts.size()); ++i) {
        const std::string part = NameOf(trigger.parts[i]);  // scripts may make parts
        for (const bool entered : {true, false}) {
          Call("on_trigger('" + trigger.name + "', '" + part + (entered ? "', true)" : "', false)"),
               [&](Script& s) { s.OnTrigger(trigger.name, part, entered); });
        }
      }
    }
    CallTouches();
    for (std::size_t i = 0; i < scripts_.size() && scene_.lcm->message.empty(); ++i) {
      if (!scripts_[i]->Defines("on_message")) continue;
      findings_->push_back({scripts_[i]->LineOf("on_message"),
                            "script '" + scene_.scripts[i].name +
                                "': nothing calls on_message: the scene has no [[lcm.message]]"});
    }
    for (const std::string& channel : scene_.lcm->message) {
      const LcmHeard heard{channel, {0, "test", {}, ""}};
      Call("on_message('" + channel + "', {name = 'test', text = '', values = {}})",
           [&](Script& s) { s.OnMessage(heard); });
    }
    for (const Seat& seat : scene_.seats) {
      for (const char* news : {"in", "out", "far", "taken"}) {
        if (scene_.players.empty()) continue;
        const std::string& player = scene_.players[0].name;
        Call("on_seat('" + player + "', '" + seat.name + "', '" + news + "')",
             [&](Script& s) { s.OnSeat(player, seat.name, news); });
      }
    }
    for (const Player& player : scene_.players) {
      Call("on_leave('" + player.name + "')", [&](Script& s) { s.OnLeave(player.name); });
    }
  }

 private:
  static constexpr const char* kFile = "scene.toml";

  const std::string& NameOf(PartId part) const {
    return world_.scene().parts[static_cast<std::size_t>(part)].name;
  }

  void CallTouches() {
    const Composition& c = world_.composition();
    const auto body = [&](const Part& part) {
      return c.assembly_of_part[static_cast<std::size_t>(part.id)];
    };
    std::size_t pairs = 0;
    for (const Part& a : scene_.parts) {
      for (const Part& b : scene_.parts) {
        if (a.id >= b.id || body(a) < 0 || body(b) < 0 || body(a) == body(b)) continue;
        if (!MayCollide(a.filter, b.filter)) continue;
        if (MechanismOf(world_, a.id) < 0 && MechanismOf(world_, b.id) < 0) continue;
        if (++pairs > kPairsMost) return;
        Call("on_touch('" + a.name + "', '" + b.name + "')",
             [&](Script& s) { s.OnTouch(a.name, b.name); });
      }
    }
  }

  template <class F>
  void Each(const F& call) {
    for (const auto& script : scripts_) call(*script);
  }

  template <class F>
  void Call(const std::string& what, const F& call) {
    Begin();
    Each(call);
    Tell(what);
    EndTick(false);
  }

  void Begin() {
    Each([](Script& s) { s.BeginTick(); });
  }

  void RunTriggers() {
    const auto place_of = [this](PartId part) -> std::optional<Vec2> {
      BodyState state;
      if (!ReadPart(world_, part, &state)) return std::nullopt;
      return state.position;
    };
    for (const TriggerEvent& event : triggers_.Update(place_of, [](PartId) { return -1; })) {
      const std::string& name = scene_.triggers[static_cast<std::size_t>(event.trigger)].name;
      Each([&](Script& s) { s.OnTrigger(name, NameOf(event.part), event.entered); });
    }
  }

  void EndTick(bool removals) {
    const double t = static_cast<double>(world_.tick()) / scene_.solver.tick_hz;
    Each([&](Script& s) { s.OnTick(t); });
    Tell("");
    commands_.Apply(removals);
  }

  /// Adds a finding for each script that was stopped since the last call. `by`: the call that did
  /// it, "": one of its own course.
  void Tell(const std::string& by) {
    for (std::size_t i = 0; i < scripts_.size(); ++i) {
      Script& script = *scripts_[i];
      if (!script.stopped() || told_[i]) continue;
      told_[i] = true;
      int line = lines_[i];
      std::string text = script.error();
      const std::string prefix = std::string(kFile) + ":";
      if (text.compare(0, prefix.size(), prefix) == 0) {
        const std::size_t end = text.find(": ", prefix.size());
        line = std::atoi(text.c_str() + prefix.size());
        if (end != std::string::npos) text = text.substr(end + 2);
      }
      const std::string how = by.empty() ? "" : by + ": ";
      findings_->push_back({line, "script '" + script.name() + "' is stopped: " + how + text});
    }
  }

  const Scene& scene_;
  World world_;
  DryCommands commands_;
  Rules rules_;
  ScriptRoom host_;
  Triggers triggers_;
  std::vector<std::unique_ptr<Script>> scripts_;
  std::vector<int> lines_;
  std::vector<bool> told_;
  std::vector<Finding>* findings_;
};

}  // namespace

void FindInScripts(const Scene& scene, std::vector<Finding>* findings) {
  if (scene.scripts.empty()) return;
  std::vector<Finding> in_run, found;
  DryRoom room(scene, &in_run);
  const ScriptNames names = NamesOf(scene, room.host());
  for (std::size_t i = 0; i < scene.scripts.size(); ++i) {
    if (!room.script(i).compiled()) continue;
    FindInScriptCalls(names, scene.scripts[i], &found);
    FindInScriptWords(names, scene.scripts[i], &found);
  }
  room.LiveASecond();
  room.CallEachCallback();
  found.insert(found.end(), in_run.begin(), in_run.end());
  // One finding for a line: the text's says more than the run's.
  std::set<int> lines;
  for (const Finding& finding : found) {
    if (lines.insert(finding.line).second) findings->push_back(finding);
  }
}

}  // namespace seam
