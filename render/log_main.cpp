/// seam-log: recordings as files: checked, listed, cut, merged. docs/recordings.md describes it.

#include <string>

#include "common/base/command_line.h"
#include "common/codec/version_line.h"
#include "render/log/log_commands.h"

int main(int argc, char** argv) {
  using namespace seam;
  LogsCommand list;
  LogVerifyCommand verify;
  LogStatsCommand stats;
  LogEventsCommand events;
  LogTopCommand top;
  LogCutCommand cut;
  LogMergeCommand merge;
  Command* commands[8] = {};
  const ProgramText text{"seam-log", "Checks, lists, cuts and merges recordings; prints events.",
                         VersionLine("seam-log"),
                         "examples:\n"
                         "  seam-log verify session.lcm                        status 1: damaged\n"
                         "  seam-log cut session.lcm --from 10 --to 20 -o part.lcm\n"
                         "  seam-log merge laptop.lcm desktop.lcm -o both.lcm"};
  const auto define = [&](Command& app) {
    app.RequireCommand();
    Command& verifies =
        *(commands[0] = &app.Add("verify", "say that logs are whole, or where not"));
    verifies.Option("LOGS", verify.logs, "LCM logs").Required();
    verifies.Option("--log-key", verify.log_key,
                    "the key file of seam-server --log-key: find what anybody else has changed");
    Command& lists = *(commands[1] = &app.Add("list", "the sessions of logs"));
    lists.Option("LOGS", list.logs, "LCM logs").Required();
    Command& sums = *(
        commands[2] = &app.Add("stats", "rate, size and gaps of each channel, and losses by time"));
    sums.Option("LOG", stats.log, "an LCM log").Required();
    sums.Option("--room", stats.room, "of a log with several rooms (default: the first)");
    sums.Option("--session", stats.session, "number or id (default: the last)");
    sums.Switch("--csv", stats.csv, "the channels as CSV");
    Command& cuts = *(commands[3] = &app.Add("cut", "write a part of a session as a log"));
    cuts.Option("LOG", cut.log, "an LCM log").Required();
    cuts.Option("-o,--output", cut.out, "log to write").Required();
    cuts.Option("--room", cut.room, "of a log with several rooms (default: the first)");
    cuts.Option("--session", cut.session, "number or id (default: the last)");
    cuts.Option("--from", cut.range.from_s, "seconds of the session");
    cuts.Option("--to", cut.range.to_s, "seconds of the session");
    cuts.Option("--from-tick", cut.from_tick, "first tick to keep").Range(0, 2000000000);
    cuts.Option("--to-tick", cut.to_tick, "last tick to keep").Range(0, 2000000000);
    cuts.Switch("--force", cut.force, "overwrite the log");
    Command& merges =
        *(commands[4] = &app.Add("merge", "write several logs as one, each message once"));
    merges.Option("LOGS", merge.logs, "LCM logs, two or more").Required();
    merges.Option("-o,--output", merge.out, "log to write").Required();
    merges.Switch("--force", merge.force, "overwrite the log");
    Command& prints =
        *(commands[5] = &app.Add("events", "print the events of a session, and its sum"));
    prints.Option("LOG", events.log, "an LCM log").Required();
    prints.Option("--room", events.room, "of a log with several rooms (default: the first)");
    prints.Option("--session", events.session, "number or id (default: the last)");
    prints.Switch("--json", events.json, "an object on each line");
    Command& ranks =
        *(commands[6] = &app.Add("top", "the leaderboard and past sessions of a server's --store"));
    ranks.Option("STORE", top.store, "a database of seam-server --store").Required();
    ranks.Option("--scene", top.scene, "of this scene alone, by its name");
    ranks.Option("--by", top.by, "best score, or time in rooms").OneOf({"score", "time"});
    ranks.Option("--limit", top.limit, "lines of each table").Range(1, 1000000);
    commands[7] = &app.Add("types", "the fingerprints of the LCM types, as programs compare them");
  };
  return RunCommandLine(text, argc, argv, define, [&] {
    if (commands[0]->chosen()) return RunLogVerify(verify);
    if (commands[1]->chosen()) return RunLogList(list);
    if (commands[2]->chosen()) return RunLogStats(stats);
    if (commands[3]->chosen()) return RunLogCut(cut);
    if (commands[4]->chosen()) return RunLogMerge(merge);
    if (commands[5]->chosen()) return RunLogEvents(events);
    if (commands[6]->chosen()) return RunLogTop(top);
    return RunLogTypes();
  });
}
