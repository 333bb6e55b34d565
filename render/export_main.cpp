/// seam-export: a recording in formats that other programs read. docs/recordings.md describes them.

#include <unistd.h>

#include <cstdio>
#include <optional>

#include "common/base/check.h"
#include "common/base/command_line.h"
#include "common/base/process.h"
#include "common/base/progress_count.h"
#include "common/codec/version_line.h"
#include "render/export/formats.h"
#include "render/export/options.h"

namespace seam {
namespace {

void Write(const ExportSession& session, ExportFormat format, OutputFile* out) {
  switch (format) {
    case ExportFormat::kCsv: return WriteCsvExport(session, out);
    case ExportFormat::kJson: return WriteJsonExport(session, out);
    case ExportFormat::kMcap: return WriteMcapExport(session, out);
    case ExportFormat::kTrace: return WriteTraceExport(session, out);
  }
}

/// Writes one of the tables, if `path` names a file for it.
void WriteTable(const ExportOptions& options, const std::string& path,
                void (*write)(const ExportSession&, OutputFile*), const ExportSession& session) {
  if (path.empty()) return;
  OutputFile out(path, options.force, {options.log, options.oracle});
  write(session, &out);
  out.Finish();
}

int Run(const ExportOptions& options) {
  CheckExportOptions(options);
  StopOnSignals();
  const bool to_stdout = options.out.empty() || options.out == "-";
  if (options.mcap && to_stdout && isatty(STDOUT_FILENO) != 0) {
    throw OperatorError("--mcap is not text: say where it goes with -o");
  }
  std::optional<OutputFile> out;
  if (options.HasFormat()) {
    out.emplace(options.out, options.force, std::vector<std::string>{options.log, options.oracle});
  }
  ExportSession session = LoadExport(options);
  for (const std::string& line : session.lacking) {
    PrintError("seam-export", "warning: " + options.log + ": " + line);
  }
  std::optional<ProgressCount> count;
  session.progress = [&count](std::int64_t done, std::int64_t ticks) {
    if (!count) count.emplace("exporting", "ticks", ticks);
    (*count)(done);
  };
  WriteTable(options, options.events, WriteEventsTable, session);
  WriteTable(options, options.metrics, WriteMetricsTable, session);
  if (out) {
    Write(session, options.format(), &*out);
    count.reset();
    out->Finish();
  }
  return session.damaged ? 1 : 0;
}

}  // namespace
}  // namespace seam

int main(int argc, char** argv) {
  using namespace seam;
  ExportOptions options;
  const ProgramText text{
      "seam-export", "Writes a recording as CSV, JSON, MCAP (Foxglove, Rerun) or a Perfetto trace.",
      VersionLine("seam-export"),
      "examples:\n"
      "  seam-export session.lcm --csv -o session.csv             all views and bodies\n"
      "  seam-export session.lcm --csv --view ann --body crate1   to stdout\n"
      "  seam-export session.lcm --mcap -o session.mcap           for Foxglove and Rerun\n"
      "  seam-export session.lcm --events events.csv              joined, left, scored, broke ...\n"
      "  seam-export session.lcm --trace -o session.json          for ui.perfetto.dev"};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { DefineExportOptions(&app, &options); },
      [&] { return Run(options); });
}
