#include "tests/lab/rows.h"

#include <algorithm>
#include <cstdio>
#include <thread>

#include "common/base/process.h"
#include "common/base/progress_count.h"
#include "tests/lab/jobs.h"

namespace seam {

int JobsOr(int wanted) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return wanted > 0 ? wanted : cores;
}

std::vector<std::size_t> MissingRows(const SweepTable& table, std::size_t rows) {
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < rows; ++i) {
    if (!table.Has(i)) missing.push_back(i);
  }
  return missing;
}

RowsDone MakeRows(const std::vector<std::string>& keys, const std::vector<std::size_t>& todo,
                  const RowMaker& maker, int jobs, bool quiet, SweepTable* table) {
  ProgressCount progress("measuring", "runs", static_cast<std::int64_t>(todo.size()), quiet);
  const std::size_t before = table->count();
  RowsDone done;
  RunJobs(
      todo.size(), jobs, [&](std::size_t i) { return maker.make(todo[i]); },
      [&](std::size_t i, const JobResult& result) {
        std::optional<std::string> line;
        if (result.good) {
          line = result.text;
        } else if (maker.rescue) {
          line = maker.rescue(todo[i], result.text);
        }
        if (line) {
          table->Add(todo[i], *line);
        } else {
          ++done.failed;
          progress.End();
          std::fprintf(stderr, "seam-lab: failed: %s: %s\n", keys[todo[i]].c_str(),
                       result.text.c_str());
        }
        progress(static_cast<std::int64_t>(i) + 1);
      },
      [] { return g_stop != 0; });
  done.added = table->count() - before;
  return done;
}

int PrintRows(const std::string& path, const SweepTable& table, std::size_t rows,
              const RowsDone& done) {
  std::printf("%s: %zu of %zu rows, %zu of them new", path.c_str(), table.count(), rows,
              done.added);
  if (done.failed > 0) std::printf("; %zu runs failed", done.failed);
  if (g_stop != 0) std::printf("; stopped: the same command goes on");
  std::printf("\n");
  return table.count() == rows ? 0 : 1;
}

}  // namespace seam
