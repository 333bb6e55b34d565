#include "render/export/options.h"

#include <CLI/CLI.hpp>

#include "common/base/check.h"

namespace seam {

ExportFormat ExportOptions::format() const {
  if (csv) return ExportFormat::kCsv;
  if (json) return ExportFormat::kJson;
  return mcap ? ExportFormat::kMcap : ExportFormat::kTrace;
}

void DefineExportOptions(CLI::App* app, ExportOptions* options) {
  ExportOptions& o = *options;
  app->add_option("LOG", o.log, "a recording (LCM log)");
  app->add_flag("--csv", o.csv, "a row for each tick, view and body");
  app->add_flag("--json", o.json, "one document: room, players, bodies, edits, inputs, poses");
  app->add_flag("--mcap", o.mcap, "for Foxglove and Rerun");
  app->add_flag("--trace", o.trace, "for ui.perfetto.dev: peers, authority, messages, errors");
  app->add_option("-o,--out", o.out, "the file to write (stdout)");
  app->add_flag("--force", o.force, "replace the file if it is there");
  app->add_option("--from", o.range.from_s, "first moment of the session, s");
  app->add_option("--to", o.range.to_s, "last moment of the session, s");
  app->add_option("--body", o.bodies, "these bodies only, by the names of their root parts")
      ->delimiter(',')
      ->allow_extra_args(false);  // the log may follow it
  app->add_option("--view", o.views, "these views only: players' names, or server")
      ->delimiter(',')
      ->allow_extra_args(false);
  app->add_option("--oracle", o.oracle, "log of the same scene made in mode oracle (computed)");
  app->add_option("--room", o.room, "which room, if there are several");
}

void CheckExportOptions(const ExportOptions& o) {
  if (o.log.empty()) throw OperatorError("which log? for example: seam-export session.lcm --csv");
  const int formats = int{o.csv} + int{o.json} + int{o.mcap} + int{o.trace};
  if (formats != 1) throw OperatorError("say one of --csv, --json, --mcap and --trace");
}

}  // namespace seam
