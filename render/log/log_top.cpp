/// seam-log: top.

#include <cstdio>

#include "common/record/store/store.h"
#include "render/log/log_commands.h"

namespace seam {

int RunLogTop(const LogTopCommand& command) {
  Store store(command.store, Store::Use::kRead);
  const RankBy by = command.by == "time" ? RankBy::kTime : RankBy::kScore;
  std::printf("%4s  %-20s %10s %10s %9s\n", "", "player", "best score", "time", "sessions");
  int place = 0;
  for (const StoredRank& rank : store.Ranks(command.scene, by, command.limit)) {
    std::printf("%4d  %-20s %10g %8.1f s %9lld\n", ++place, rank.name.c_str(), rank.best_score,
                rank.time_s, static_cast<long long>(rank.sessions));
  }
  std::printf("\n%-19s  %-16s  %-12s %-16s %-20s %10s %7s %7s  %s\n", "began (UTC)", "session",
              "room", "scene", "method", "time", "players", "events", "ended");
  for (const StoredLine& line : store.Sessions(command.scene, command.limit)) {
    std::printf("%-19s  %-16s  %-12s %-16s %-20s %8.1f s %7lld %7lld  %s\n", line.began.c_str(),
                line.session.c_str(), line.room.c_str(), line.scene.c_str(), line.method.c_str(),
                line.time_s, static_cast<long long>(line.players),
                static_cast<long long>(line.events), line.ended.c_str());
  }
  return 0;
}

}  // namespace seam
