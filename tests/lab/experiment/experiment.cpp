#include "tests/lab/experiment/experiment.h"

#include <algorithm>
#include <cstdio>
#include <thread>

#include "common/base/process.h"
#include "common/base/progress_count.h"
#include "tests/lab/experiment/jobs.h"

namespace seam {

Flag AddTableFlag(Command& command, TableFlags& flags) {
  return command.Option("-o,--output", flags.table, "CSV table to write, or to complete");
}

void AddRunFlags(Command& command, TableFlags& flags, const char* jobs) {
  command.Option("--jobs", flags.jobs, jobs).Range(1, 256);
  command.Switch("--force", flags.force, "begin the table anew");
  command.Switch("--quiet", flags.quiet, "no progress line");
}

int JobsOr(int wanted) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return wanted > 0 ? wanted : cores;
}

std::unique_ptr<ResultTable> OpenTable(const Experiment& experiment, const TableFlags& flags) {
  return std::make_unique<ResultTable>(flags.table, experiment.key_columns,
                                       experiment.value_columns, experiment.keys, flags.force);
}

std::vector<std::size_t> MissingRows(const ResultTable& table, std::size_t rows) {
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < rows; ++i) {
    if (!table.Has(i)) missing.push_back(i);
  }
  return missing;
}

RowsDone MakeRows(const Experiment& experiment, const TableFlags& flags, ResultTable* table) {
  const std::vector<std::size_t> todo = MissingRows(*table, experiment.keys.size());
  ProgressCount progress("measuring", "runs", static_cast<std::int64_t>(todo.size()), flags.quiet);
  RowsDone done;
  RunJobs(
      todo.size(), JobsOr(flags.jobs), [&](std::size_t i) { return experiment.measure(todo[i]); },
      [&](std::size_t i, const JobResult& result) {
        const std::string& key = experiment.keys[todo[i]];
        std::optional<std::string> values;
        if (result.good) {
          values = result.text;
        } else if (experiment.rescue) {
          values = experiment.rescue(todo[i], result.text);
        }
        if (values) {
          table->Add(todo[i], key + ',' + *values);
          ++done.added;
        } else {
          ++done.failed;
          progress.End();
          std::fprintf(stderr, "seam-lab: failed: %s: %s\n", key.c_str(), result.text.c_str());
        }
        progress(static_cast<std::int64_t>(done.added + done.failed));
      },
      [] { return g_stop != 0; });
  return done;
}

int PrintRows(const TableFlags& flags, const ResultTable& table, std::size_t rows,
              const RowsDone& done) {
  std::printf("%s: %zu of %zu rows, %zu of them new", flags.table.c_str(), table.count(), rows,
              done.added);
  if (done.failed > 0) std::printf("; %zu runs failed", done.failed);
  if (g_stop != 0) std::printf("; stopped: the same command goes on");
  std::printf("\n");
  return table.count() == rows ? 0 : 1;
}

int CompleteTable(const Experiment& experiment, const TableFlags& flags) {
  const std::unique_ptr<ResultTable> table = OpenTable(experiment, flags);
  StopOnSignals();
  const RowsDone done = MakeRows(experiment, flags, table.get());
  return PrintRows(flags, *table, experiment.keys.size(), done);
}

}  // namespace seam
