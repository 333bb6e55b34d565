#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "common/base/check.h"
#include "common/base/process.h"
#include "tests/lab/commands.h"
#include "tests/lab/grid.h"
#include "tests/lab/jobs.h"
#include "tests/lab/sweep_row.h"
#include "tests/lab/sweep_table.h"

namespace seam {
namespace {

std::string Span(double seconds) {
  const auto s = static_cast<std::int64_t>(seconds);
  if (s < 60) return fmt::format("{} s", s);
  return s < 3600 ? fmt::format("{} min {} s", s / 60, s % 60)
                  : fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

/// How far it is, and how long it will take at the mean pace so far: on a terminal a line that
/// renews itself, elsewhere a line a minute.
class Progress {
 public:
  Progress(std::size_t total, bool quiet)
      : total_(total), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}
  void operator()(std::size_t done) {
    const std::int64_t now_us = SteadyClockUs();
    if (quiet_ || now_us - last_us_ < (terminal_ ? 200000 : 60000000)) return;
    last_us_ = now_us;
    const double pace = static_cast<double>(now_us - begin_us_) / static_cast<double>(done);
    std::fprintf(stderr, "%s%zu of %zu runs, about %s left%s", terminal_ ? "\r" : "", done, total_,
                 Span(pace * static_cast<double>(total_ - done) * 1e-6).c_str(),
                 terminal_ ? "      " : "\n");
    shown_ = true;
  }
  ~Progress() {
    if (shown_ && terminal_) std::fputc('\n', stderr);
  }

 private:
  std::size_t total_;
  bool quiet_, terminal_, shown_ = false;
  std::int64_t begin_us_ = SteadyClockUs();
  std::int64_t last_us_ = begin_us_;
};

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
