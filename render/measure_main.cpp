/// seam-measure: measures recordings. docs/metrics.md defines each measure.

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "common/base/check.h"
#include "common/base/command_line.h"
#include "common/base/plain_file.h"
#include "common/base/progress_count.h"
#include "common/codec/version_line.h"
#include "common/measure/around/around.h"
#include "common/measure/contents/contents.h"
#include "common/measure/contents/divergence_table.h"
#include "common/measure/contents/doubts.h"
#include "common/measure/contents/log_audit.h"
#include "common/measure/contents/partial_views.h"
#include "common/measure/handover_list.h"
#include "common/measure/limit/held_inputs.h"
#include "common/measure/preconditions.h"
#include "common/measure/revisions.h"
#include "common/measure/screen/response.h"
#include "common/measure/table.h"
#include "common/record/damage.h"
#include "common/record/loss_timeline.h"
#include "common/record/recording.h"
#include "common/record/time_range.h"
#include "render/measure/logs_and_tables.h"
#include "render/measure/readable_table.h"

namespace seam {
namespace {

struct Options {
  std::vector<std::string> logs;
  std::string oracle;
  std::string csv;
  bool append = false;
  bool force = false;
  bool more = false;
  bool wide = false;
  bool floor = false;
  bool limit = false;
  bool trust = false;
  bool audit = false;
  bool divergence = false;
  bool losses = false;
  std::string losses_csv;
  std::string around;  // an event; "": none
  std::string around_csv;
  bool list = false;
  std::vector<std::string> names;
  std::vector<std::string> sessions;
  TimeRange range;
};

/// Reads a log, and reports its damage on stderr.
Recording Read(const std::string& path, const std::string& session) {
  Recording recording = ReadRecording(path, "", session);
  ReportDamage("seam-measure", path, recording);
  return recording;
}

/// Reads the log of this index.
Recording ReadLog(const Options& options, std::size_t i) {
  return Read(options.logs[i], options.sessions.empty() ? "" : options.sessions[i]);
}

/// Returns the oracle given by --oracle. Throws OperatorError unless it fits `recording`.
Oracle GivenOracle(const Recording& truth, const Recording& recording, const Options& options,
                   const std::string& path) {
  RequireOracleOf(truth.room, options.oracle, recording.room, path);
  return OracleFromRecording(truth);
}

/// A log's measures, and its errors around the event that is asked for.
struct MeasuredLog {
  MeasuredRun run;
  std::optional<ErrorAround> around;
};

MeasuredLog MeasureLog(std::size_t i, const Options& options,
                       const std::optional<Recording>& truth) {
  const std::string& path = options.logs[i];
  Recording recording = ReadLog(options, i);
  const std::string sessions = ChosenSession(recording);
  if (!sessions.empty()) {
    std::fprintf(stderr, "seam-measure: note: %s: %s\n", path.c_str(), sessions.c_str());
  }
  const std::string changes = ChangesOf(recording);
  if (!changes.empty()) {
    std::fprintf(stderr, "seam-measure: note: %s: changed while it ran: %s (seam-log events)\n",
                 path.c_str(), changes.c_str());
  }
  RequireRange(options.range, recording, path);
  const std::string no_oracle = truth ? "" : WhyNoOracle(recording);
  Oracle oracle;
  if (truth) oracle = GivenOracle(*truth, recording, options, path);
  if (!truth && no_oracle.empty()) oracle = ComputeOracle(recording, JudgeOf(recording.room));
  KeepRange(options.range, &recording);  // the oracle needs the whole of it
  MeasuredLog measured;
  MeasuredRun& run = measured.run;
  run.run = options.names.empty() ? BaseName(path) + SessionSuffix(recording) : options.names[i];
  run.room = recording.room;
  run.measures = Measure(recording, oracle);
  MeasureResponse(recording, oracle, &run.measures);
  run.valid = no_oracle.empty() ? WhyNotValid(recording, oracle, run.measures) : no_oracle;
  run.lacks = LackOf(recording);
  run.gaps = recording.bus_gaps;
  run.skipped_bytes = recording.skipped_bytes;
  const Scene scene = RecordedScene(recording.room);
  const std::string partial = PartialViewsText(PartialViews(scene, recording),
                                               [&](int peer) { return ViewNameOf(scene, peer); });
  if (!partial.empty()) {
    std::fprintf(stderr, "seam-measure: note: %s: %s\n", path.c_str(), partial.c_str());
  }
  if (run.measures.compared == 0) {
    const std::string why = no_oracle.empty() ? "no view of a tick that the oracle has" : no_oracle;
    std::fprintf(stderr, "seam-measure: warning: %s: no errors: %s\n", path.c_str(), why.c_str());
  }
  if (options.around.empty()) return measured;
  measured.around = FindErrorAround(recording, oracle, run.measures, options.around);
  if (measured.around) {
    measured.around->run = run.run;
  } else {
    std::fprintf(stderr, "seam-measure: warning: %s: no errors around %s: %s\n", path.c_str(),
                 options.around.c_str(),
                 run.measures.compared == 0 ? "there is no oracle" : "there is no such event");
  }
  return measured;
}

/// Checks the files to write: `seam-measure --csv a.lcm b.lcm` lacks a file name, and must not
/// overwrite a recording with a table, not even with --force.
void CheckTables(const Options& options) {
  std::vector<std::string> read = options.logs;
  if (!options.oracle.empty()) read.push_back(options.oracle);
  if (!options.losses_csv.empty()) RequireOutput(options.losses_csv, options.force, read);
  if (!options.around_csv.empty()) RequireOutput(options.around_csv, options.force, read);
  if (options.csv.empty()) return;
  const std::string existing = FirstLine(options.csv);
  if (!existing.empty() && existing != CsvHeader()) {
    throw OperatorError(options.csv + (options.append ? ": has other columns, cannot append to it"
                                                      : ": exists and is no table of measures"));
  }
  RequireOutput(options.csv, options.force || options.append, read);
}

void WriteCsv(const std::vector<MeasuredRun>& runs, const Options& options) {
  const std::string header = options.append ? FirstLine(options.csv) : "";
  std::FILE* file =
      OpenPlainFile(options.csv, options.append ? FileUse::kAppend : FileUse::kReplace);
  if (file == nullptr) throw OperatorError(options.csv + ": cannot be written");
  std::string text = header.empty() ? CsvHeader() + '\n' : "";
  for (const MeasuredRun& run : runs) text += CsvLine(run) + '\n';
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written) throw OperatorError(options.csv + ": disk full?");
}

/// Prints a line a run, as scripts read it, or at a terminal the table for people.
void PrintTable(const std::vector<MeasuredRun>& runs, const Options& options) {
  if (options.wide || isatty(STDOUT_FILENO) == 0) {
    std::fputs(FormatTable(runs, options.more).c_str(), stdout);
    return;
  }
  constexpr std::size_t kUnknownWidth = 80;
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  const std::size_t width = known ? size.ws_col : kUnknownWidth;
  std::fputs(FormatReadable(runs, width, options.names.empty()).c_str(), stdout);
  for (const MeasuredRun& run : runs) {
    if (options.more) std::fputs(FormatMore(run).c_str(), stdout);
  }
}

void PrintLimit(const Recording& recording) {
  const std::optional<double> limit = HeldInputsError(recording);
  if (!limit) {
    std::printf("inputs held, %s: no player lacks an input of another one\n",
                recording.room.scene_name.c_str());
    return;
  }
  std::printf(
      "inputs held, %s: %.3g m RMS (exact physics, others' inputs held since the newest "
      "that can be known)\n",
      recording.room.scene_name.c_str(), *limit);
}

void PrintFloor(const Recording& recording) {
  std::printf(
      "floor of %s: %.3g m RMS (the oracle against itself, one body moved by 1e-6 m; "
      "median over bodies)\n",
      recording.room.scene_name.c_str(), ErrorFloor(recording, ComputeOracle(recording)));
}

void PrintHandOvers(Recording recording, const std::string& name, const TimeRange& range) {
  KeepRange(range, &recording);
  const Scene scene = RecordedScene(recording.room);
  const RevisionHistory revisions(scene, recording);
  const std::string list = FormatHandOvers(ListHandOvers(recording, &revisions));
  if (!list.empty()) std::printf("\nhand-overs of %s\n%s", name.c_str(), list.c_str());
}

/// Reports when and on which channel each log lost messages; of several logs with their names.
void ReportLosses(const Options& options) {
  std::string csv;
  for (std::size_t i = 0; i < options.logs.size(); ++i) {
    const std::string& path = options.logs[i];
    const std::vector<Loss> losses = Within(FindLosses(path, ReadLog(options, i)), options.range);
    if (options.losses) {
      std::printf("\nlosses of %s\n%s", BaseName(path).c_str(), FormatLosses(losses).c_str());
    }
    csv += LossesCsv(losses);
  }
  if (options.losses_csv.empty()) return;
  if (options.logs.size() > 1) throw OperatorError("--losses-csv is of one log");
  WriteText(options.losses_csv, csv);
}

/// Prints and writes the errors around the event.
void ReportAround(const std::vector<ErrorAround>& runs, const Options& options) {
  if (runs.empty()) return;
  std::printf("\nerror around %s, RMS of all views\n%s", options.around.c_str(),
              FormatAround(runs).c_str());
  if (!options.around_csv.empty()) WriteText(options.around_csv, AroundCsv(runs));
}

void Run(const Options& options) {
  if (!options.names.empty() && options.names.size() != options.logs.size()) {
    throw OperatorError("--names has " + std::to_string(options.names.size()) + " names for " +
                        std::to_string(options.logs.size()) + " logs");
  }
  if (options.range.given() && (options.floor || options.limit)) {
    throw OperatorError("--floor and --limit are of whole sessions: not with --from and --to");
  }
  CheckTables(options);
  std::optional<Recording> truth;
  if (!options.oracle.empty()) truth = Read(options.oracle, "");
  std::vector<MeasuredRun> runs;
  std::vector<ErrorAround> arounds;
  ProgressCount progress("measuring", "logs", static_cast<std::int64_t>(options.logs.size()));
  for (std::size_t i = 0; i < options.logs.size(); ++i) {
    progress(static_cast<std::int64_t>(i));
    MeasuredLog measured = MeasureLog(i, options, truth);
    runs.push_back(std::move(measured.run));
    if (measured.around) arounds.push_back(std::move(*measured.around));
  }
  progress.End();
  if (!options.csv.empty()) WriteCsv(runs, options);
  PrintTable(runs, options);
  for (std::size_t i = 0; options.more && i < runs.size(); ++i) {
    PrintHandOvers(ReadLog(options, i), runs[i].run, options.range);
  }
  for (std::size_t i = 0; options.trust && i < runs.size(); ++i) {
    const Recording recording = ReadLog(options, i);
    std::printf("\ndoubts of %s\n%s", runs[i].run.c_str(),
                FormatDoubts(recording, RecordedScene(recording.room)).c_str());
  }
  for (std::size_t i = 0; options.divergence && i < runs.size(); ++i) {
    const Recording recording = ReadLog(options, i);
    std::printf("\ndivergence in %s\n%s", runs[i].run.c_str(),
                FormatDivergences(recording, RecordedScene(recording.room)).c_str());
  }
  for (std::size_t i = 0; options.audit && i < runs.size(); ++i) {
    const Recording recording = ReadLog(options, i);
    std::printf("\naudit of %s\n%s", runs[i].run.c_str(),
                FormatAudit(AuditRecording(recording), recording).c_str());
  }
  ReportAround(arounds, options);
  if (options.losses || !options.losses_csv.empty()) ReportLosses(options);
  if (options.floor) PrintFloor(ReadLog(options, 0));
  if (options.limit) PrintLimit(ReadLog(options, 0));
}

void Define(Command& app, Options& options) {
  app.Option("LOG", options.logs, "recordings (LCM logs)");
  app.Option("--from", options.range.from_s, "measure from this moment of the session on, s");
  app.Option("--to", options.range.to_s, "measure up to this moment of the session, s");
  app.Option("--oracle", options.oracle,
             "a recording made with --mode oracle; without it the oracle is computed");
  app.Option("--csv", options.csv, "write the table as CSV to this file too");
  app.Switch("--append", options.append, "add to the CSV file instead of replacing it");
  app.Switch("--force", options.force, "replace the tables if they are there");
  app.Option("--names", options.names, "what to call the runs, in the order of the logs")
      .CommaSeparated()
      .OneValueEach();  // the logs may follow it
  app.Option("--session", options.sessions,
             "which session of each log, if it has several: its number, or its id (the last)")
      .CommaSeparated()
      .OneValueEach();
  app.Switch("--floor", options.floor, "also print what chaos alone does to the first log");
  app.Switch("--limit", options.limit,
             "also print what nobody could show better over the first log's network");
  app.Switch("--losses", options.losses,
             "also print when and where something was lost, by channel");
  app.Option("--losses-csv", options.losses_csv, "write the losses of the log as CSV to this file");
  app.Option("--around", options.around,
             "also say the error around an event of each log: contact, worst, hand-over or a tick");
  app.Option("--around-csv", options.around_csv,
             "write the error by tick around that event as CSV to this file");
  app.Switch("--trust", options.trust, "also list the server's doubts about clients");
  app.Switch("--audit", options.audit,
             "also step the bodies of each client again: who gained speed beside physics?");
  app.Switch("--divergence", options.divergence,
             "also list where peers differed from each other at the same tick");
  app.Switch("--list", options.list, "say what is in the logs, and measure nothing");
  app.Switch("--more", options.more, "print the further measures");
  app.Switch("--wide", options.wide, "at a terminal too, print one line a run, as into a pipe");
}

}  // namespace
}  // namespace seam

int main(int argc, char** argv) {
  using namespace seam;
  Options options;
  const ProgramText text{"seam-measure",
                         "Measures recordings against the truth: error, stutter, rebound, cost.",
                         VersionLine("seam-measure"), ""};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { Define(app, options); },
      [&] {
        if (options.logs.empty()) {
          throw OperatorError("which log? for example: seam-measure session.lcm");
        }
        if (!options.around.empty()) RequireEventWord(options.around);
        if (!options.around_csv.empty() && options.around.empty()) {
          throw OperatorError("--around-csv needs --around EVENT");
        }
        if (options.append && options.csv.empty()) throw OperatorError("--append needs --csv");
        CheckSessions(options.sessions, options.logs.size());
        if (options.list) {
          for (std::size_t i = 0; i < options.logs.size(); ++i) {
            std::fputs(FormatContents(options.logs[i], ReadLog(options, i)).c_str(), stdout);
          }
        } else {
          Run(options);
        }
        if (std::fflush(stdout) != 0) throw OperatorError("stdout: disk full?");
        return StatusAfterReading(0);
      });
}
