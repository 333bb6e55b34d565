#include <algorithm>
#include <cstdio>
#include <thread>

#include "common/base/check.h"
#include "common/base/process.h"
#include "tests/lab/commands.h"
#include "tests/lab/grid.h"
#include "tests/lab/jobs.h"
#include "tests/lab/progress.h"
#include "tests/lab/sweep_row.h"
#include "tests/lab/sweep_table.h"

namespace seam {
namespace {

/// Runs the points of `todo`; returns how many failed.
std::size_t RunPoints(const Grid& grid, const std::vector<std::size_t>& todo, int jobs, bool quiet,
                      SweepTable* table) {
  Progress progress(todo.size(), quiet);
  std::size_t failed = 0;
  RunJobs(
      todo.size(), jobs,
      [&](std::size_t i) { return SweepRow(grid.points[todo[i]], grid.floor); },
      [&](std::size_t i, const JobResult& result) {
        if (result.good) {
          table->Add(todo[i], result.text);
        } else {
          ++failed;
          std::fprintf(stderr, "seam-lab: failed: %s: %s\n", grid.points[todo[i]].key.c_str(),
                       result.text.c_str());
        }
        progress(i + 1);
      },
      [] { return g_stop != 0; });
  return failed;
}

}  // namespace

int RunSweep(const SweepCommand& command) {
  const Grid grid = ReadGrid(command.file);
  std::vector<std::string> keys;
  for (const GridPoint& point : grid.points) keys.push_back(point.key);
  SweepTable table(command.table, SweepHeader(), kGridColumns, keys, command.force);
  const std::size_t before = table.count();
  std::vector<std::size_t> todo;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (!table.Has(i)) todo.push_back(i);
  }
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  StopOnSignals();
  const std::size_t failed =
      RunPoints(grid, todo, command.jobs > 0 ? command.jobs : cores, command.quiet, &table);
  std::printf("%s: %zu of %zu rows, %zu of them new", command.table.c_str(), table.count(),
              keys.size(), table.count() - before);
  if (failed > 0) std::printf("; %zu runs failed", failed);
  if (g_stop != 0) std::printf("; stopped: the same command goes on");
  std::printf("\n");
  return table.count() == keys.size() ? 0 : 1;
}

}  // namespace seam
