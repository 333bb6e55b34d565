#include "render/export/options.h"

#include "common/base/check.h"
#include "common/base/command_line.h"

namespace seam {

ExportFormat ExportOptions::format() const {
  if (csv) return ExportFormat::kCsv;
  if (json) return ExportFormat::kJson;
  return mcap ? ExportFormat::kMcap : ExportFormat::kTrace;
}

void DefineExportOptions(Command* app, ExportOptions* options) {
  ExportOptions& o = *options;
  app->Option("LOG", o.log, "a recording (LCM log)");
  app->Switch("--csv", o.csv, "a row for each tick, view and body");
  app->Switch("--json", o.json, "one document: room, players, bodies, edits, inputs, poses");
  app->Switch("--mcap", o.mcap, "for Foxglove and Rerun");
  app->Switch("--trace", o.trace, "for ui.perfetto.dev: peers, authority, messages, errors");
  app->Option("-o,--out", o.out, "the file to write (stdout)");
  app->Option("--events", o.events, "write the events to this CSV file, a row each");
  app->Option("--metrics", o.metrics,
              "write the peers' counters to this CSV file, a row for each second");
  app->Switch("--force", o.force, "replace the file if it is there");
  app->Option("--from", o.range.from_s, "first moment of the session, s");
  app->Option("--to", o.range.to_s, "last moment of the session, s");
  app->Option("--body", o.bodies, "these bodies only, by the names of their root parts")
      .CommaSeparated()
      .OneValueEach();  // the log may follow it
  app->Option("--view", o.views, "these views only: players' names, or server")
      .CommaSeparated()
      .OneValueEach();
  app->Option("--oracle", o.oracle, "log of the same scene made in mode oracle (computed)");
  app->Option("--room", o.room, "which room, if there are several");
  app->Option("--session", o.session,
              "which session, if there are several: its number, or its id (the last)");
}

void CheckExportOptions(const ExportOptions& o) {
  if (o.log.empty()) throw OperatorError("which log? for example: seam-export session.lcm --csv");
  const int formats = int{o.csv} + int{o.json} + int{o.mcap} + int{o.trace};
  const bool tables = !o.events.empty() || !o.metrics.empty();
  if (formats > 1 || (formats == 0 && !tables)) {
    throw OperatorError(
        "say one of --csv, --json, --mcap and --trace, or --events FILE or --metrics FILE");
  }
}

}  // namespace seam
