/// Rules: calls the scripts after each tick with the tick's events.

#include <algorithm>
#include <iterator>

#include "common/scene/part_rules.h"
#include "server/rules/rules.h"
#include "server/script/script.h"

namespace seam {

void Rules::RunScripts() {
  const bool wanted = std::any_of(scripts_.begin(), scripts_.end(),
                                  [](const auto& script) { return script->Defines("on_touch"); });
  std::vector<PartTouch> now;
  if (wanted) now = world_.PartTouches();
  std::vector<PartTouch> begun;
  std::set_difference(now.begin(), now.end(), touching_.begin(), touching_.end(),
                      std::back_inserter(begun));
  touching_ = std::move(now);
  const auto name = [this](PartId part) -> const std::string& {
    return scene().parts[static_cast<std::size_t>(part)].name;
  };
  const double t = static_cast<double>(world_.tick()) / scene().solver.tick_hz;
  for (const auto& script : scripts_) {
    if (!script->stopped()) {
      script->BeginTick();
      for (const PlayerEvent& event : player_events_) {
        const std::string player = PlayerName(event.player);
        event.joins ? script->OnJoin(player) : script->OnLeave(player);
      }
      for (const PartTouch& touch : begun) script->OnTouch(name(touch.a), name(touch.b));
      for (const TriggerEvent& event : happened_) {
        const Trigger& trigger = scene().triggers[static_cast<std::size_t>(event.trigger)];
        script->OnTrigger(trigger.name, name(event.part), event.entered);
      }
      script->OnTick(t);
    }
    if (script->stopped()) ReportStopped(*script);
  }
}

void Rules::ReportStopped(Script& script) {
  if (!stopped_reported_.insert(script.name()).second) return;
  commands_.Warn("script " + script.name() + " is stopped: " + script.error());
}

}  // namespace seam
