/// Rules: calls the scripts after each tick with the tick's events.

#include <algorithm>
#include <utility>

#include "common/scene/part_rules.h"
#include "server/rules/rules.h"
#include "server/script/script.h"

namespace seam {
namespace {

const char* NameOf(SeatNews news) {
  switch (news) {
    case SeatNews::kGotIn: return "in";
    case SeatNews::kGotOut: return "out";
    case SeatNews::kTooFar: return "far";
    case SeatNews::kTaken: break;
  }
  return "taken";
}

}  // namespace

bool Rules::WantTouches() const {
  return std::any_of(scripts_.begin(), scripts_.end(),
                     [](const auto& script) { return script->Defines("on_touch"); });
}

/// Finds the players that have got into seats or out of them in this tick.
void Rules::NoteSeats() {
  const std::vector<Seat>& seats = scene().seats;
  seated_.resize(seats.size(), -1);
  for (std::size_t s = 0; s < seats.size(); ++s) {
    const int before = std::exchange(seated_[s], seats[s].player);
    if (before == seats[s].player) continue;
    if (before >= 0) OnSeat(before, static_cast<int>(s), SeatNews::kGotOut);
    if (seats[s].player >= 0) OnSeat(seats[s].player, static_cast<int>(s), SeatNews::kGotIn);
  }
}

void Rules::RunScripts() {
  NoteSeats();
  const std::vector<PartTouch> begun = source_.TakeTouches();
  const auto name = [this](PartId part) -> const std::string& {
    return scene().parts[static_cast<std::size_t>(part)].name;
  };
  const double t = static_cast<double>(world_.tick()) / scene().solver.tick_hz;
  for (const auto& script : scripts_) {
    if (!script->stopped()) {
      script->BeginTick();
      for (const LcmHeard& heard : messages_) script->OnMessage(heard);
      for (const PlayerEvent& event : player_events_) {
        const std::string player = PlayerName(event.player);
        event.joins ? script->OnJoin(player) : script->OnLeave(player);
      }
      for (const SeatEvent& event : seat_events_) {
        const Seat& seat = scene().seats[static_cast<std::size_t>(event.seat)];
        script->OnSeat(PlayerName(event.player), seat.name, NameOf(event.news));
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
