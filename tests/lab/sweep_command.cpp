#include <filesystem>
#include <set>
#include <string>

#include "tests/lab/commands.h"
#include "tests/lab/experiment/shard.h"
#include "tests/lab/grid.h"
#include "tests/lab/shards/merge.h"
#include "tests/lab/sweep_row.h"

namespace seam {
namespace {

/// The columns that are not a function of those before them: times of this machine.
const std::set<std::string> kTimes = {"cpu_s", "server_cpu_s", "server_us_per_body"};

/// `grid` must outlive the result.
Experiment ExperimentOf(const Grid& grid) {
  Experiment experiment;
  experiment.key_columns = SweepKeyColumns();
  experiment.value_columns = SweepValueColumns();
  experiment.texts = {"oracle", "valid", "digest"};
  experiment.filled = {"oracle", "digest"};
  for (const GridPoint& point : grid.points) experiment.keys.push_back(point.key);
  experiment.measure = [&grid](std::size_t row) {
    return CsvRow(SweepValues(grid.points[row], {grid.floor, grid.limit}));
  };
  return experiment;
}

}  // namespace

int RunSweep(const SweepCommand& command) {
  const Grid grid = ReadGrid(command.file);
  return CompleteShard(ExperimentOf(grid), command.output,
                       std::filesystem::path(command.file).stem().string());
}

int RunMerge(const MergeCommand& command) {
  const Grid grid = ReadGrid(command.file);
  return MergeTables(ExperimentOf(grid), kTimes, command);
}

int RunVerify(const VerifyCommand& command) {
  const Grid grid = ReadGrid(command.file);
  return VerifyTable(ExperimentOf(grid), kTimes, command);
}

}  // namespace seam
