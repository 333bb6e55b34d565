#include <fmt/format.h>

#include <cstdio>

#include "common/record/damage.h"
#include "tests/lab/commands.h"
#include "tests/lab/replay/replayed_room.h"

namespace seam {
namespace {

/// Returns the inputs and edits that a tick began with: "ann drive 127 lift 0 buttons 1; edit 3".
std::string Causes(const LoggedRoom& logged, const TickMessages& tick, const Server& server) {
  std::string text;
  const auto add = [&](const std::string& each) { text += (text.empty() ? "" : "; ") + each; };
  const std::vector<Player>& players = server.scene().players;
  for (std::size_t p = 0; p < players.size(); ++p) {
    const Input input = server.replica().inputs(static_cast<int>(p)).At(tick.tick);
    add(fmt::format("{} drive {} lift {} buttons {}", players[p].name, input.drive, input.lift,
                    input.buttons));
  }
  for (const auto& [number, edit] : logged.recording.edits) {
    if (edit.tick == tick.tick) add(fmt::format("edit {}", number));
  }
  return text.empty() ? "no inputs" : text;
}

}  // namespace

int RunReplay(const ReplayCommand& command) {
  const LoggedRoom logged = ReadLoggedRoom(command.log, command.session);
  ReportDamage("seam-lab", command.log, logged.recording);
  ReplayedRoom room(logged);
  while (!room.done()) {
    const TickMessages& tick = logged.ticks[static_cast<std::size_t>(room.server().tick())];
    const ReplayedRoom::Tick result = room.Step();
    if (result == ReplayedRoom::Tick::kSame) continue;
    std::printf("%s: tick %lld is the first that differs: %s; %s\n", command.log.c_str(),
                static_cast<long long>(tick.tick),
                result == ReplayedRoom::Tick::kOtherWorld ? "another world" : "other values",
                Causes(logged, tick, room.server()).c_str());
    return 1;
  }
  std::printf("%s: %zu ticks done again, each with the recorded hash\n", command.log.c_str(),
              logged.ticks.size());
  return 0;
}

}  // namespace seam
