#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/record/damage.h"
#include "common/record/room_log.h"
#include "server/edits/edit_line.h"
#include "tests/lab/commands.h"
#include "tests/lab/replay/replayed_room.h"

namespace seam {
namespace {

/// Where a room that goes on differs from the recorded one.
struct Difference {
  std::int64_t first = -1;  ///< tick; -1: none
  std::int64_t compared = 0, differing = 0;

  void Note(const TickMessages& tick, const World& world) {
    if (!tick.hash) return;
    ++compared;
    if (static_cast<std::uint16_t>(world.Hash()) == *tick.hash) return;
    if (differing++ == 0) first = tick.tick;
  }
};

/// Goes on with the recorded inputs alone: states of clients are of a room that is no more.
void GoOnAlone(const LoggedRoom& logged, const std::vector<std::string>& lines,
               std::int64_t last_tick, std::size_t next, Server* server, Difference* difference) {
  std::int64_t now_us = 0;
  const std::int64_t tick_us = 1000000 / logged.recording.room.tick_hz;
  for (std::size_t i = next; i-- > 0 && now_us == 0;) {  // a view that does not move is told seldom
    for (const AnyMessage& any : logged.ticks[i].after) {
      const auto* const view = std::get_if<View>(&any);
      if (view != nullptr) now_us = view->utime + static_cast<std::int64_t>(next - 1 - i) * tick_us;
    }
  }
  server->GoOn(now_us);
  for (const std::string& line : lines) {
    try {
      const Edit edit = ParseEditLine(line, server->replica().world().topology());
      if (!server->Order(edit)) throw OperatorError("\"" + line + "\": is not possible here");
    } catch (const OperatorError& error) {
      throw OperatorError("--edit " + std::string(error.what()));
    }
  }
  while (server->tick() < last_tick) {
    const bool recorded = next < logged.ticks.size();
    if (recorded) {
      const TickMessages& tick = logged.ticks[next];
      for (const auto* messages : {&tick.before, &tick.after}) {
        for (const AnyMessage& any : *messages) {
          const auto* inputs = std::get_if<Inputs>(&any);
          if (inputs != nullptr && messages == &tick.before) server->TakeInputs(now_us, *inputs);
        }
      }
    }
    now_us = server->next_tick_us();
    server->Tick(now_us, 0);
    if (recorded) difference->Note(logged.ticks[next++], server->replica().world());
  }
  server->Shutdown(now_us, "the time is over");
}

}  // namespace

int RunResume(const ResumeCommand& command) {
  if (!command.out.empty()) RequireOutput(command.out, command.force, {command.log});
  const LoggedRoom logged = ReadLoggedRoom(command.log, command.session);
  ReportDamage("seam-lab", command.log, logged.recording);
  const std::int64_t recorded = logged.ticks.back().tick;
  if (command.tick > recorded) {
    throw OperatorError(command.log + ": has ticks up to " + std::to_string(recorded));
  }
  const int tick_hz = logged.recording.room.tick_hz;
  const std::int64_t last = command.for_s > 0 ? command.tick + std::llround(command.for_s * tick_hz)
                                              : std::max<std::int64_t>(recorded, command.tick);
  if (command.edits.empty() && last > recorded) {
    throw OperatorError("--for: without --edit the room goes on as recorded, up to tick " +
                        std::to_string(recorded));
  }
  std::unique_ptr<RoomLog> out;
  if (!command.out.empty()) out = std::make_unique<RoomLog>(command.out, command.force, nullptr);
  ReplayedRoom room(logged, out.get());
  bool same = true;
  const std::int64_t as_recorded = command.edits.empty() ? last : command.tick;
  while (same && room.server().tick() < as_recorded) {
    same = room.Step() == ReplayedRoom::Tick::kSame;
  }
  if (!same) {
    std::printf("%s: tick %lld cannot be done again as it was: seam-lab replay says why\n",
                command.log.c_str(), static_cast<long long>(room.server().tick()));
    return 1;
  }
  Difference difference;
  if (!command.edits.empty()) {
    GoOnAlone(logged, command.edits, last, room.next(), &room.server(), &difference);
  }
  const auto number = [](std::int64_t n) { return static_cast<long long>(n); };
  if (command.edits.empty()) {
    std::printf("%s: goes on after tick %d up to tick %lld, each tick with the recorded hash\n",
                command.log.c_str(), command.tick, number(last));
  } else if (difference.first < 0) {
    std::printf("%s: goes on after tick %d up to tick %lld; the edits change nothing\n",
                command.log.c_str(), command.tick, number(last));
  } else {
    std::printf(
        "%s: goes on after tick %d up to tick %lld; tick %lld is the first that differs "
        "from the recorded, %lld of %lld do\n",
        command.log.c_str(), command.tick, number(last), number(difference.first),
        number(difference.differing), number(difference.compared));
  }
  for (const std::string& warning : room.server().TakeWarnings()) {
    std::fprintf(stderr, "seam-lab: %s\n", warning.c_str());
  }
  return room.server().script_stopped() ? 1 : 0;
}

}  // namespace seam
