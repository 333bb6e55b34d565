#include "tests/lab/commands.h"
#include "tests/lab/grid.h"
#include "tests/lab/sweep_row.h"

namespace seam {

int RunSweep(const SweepCommand& command) {
  const Grid grid = ReadGrid(command.file);
  Experiment experiment;
  experiment.key_columns = SweepKeyColumns();
  experiment.value_columns = SweepValueColumns();
  for (const GridPoint& point : grid.points) experiment.keys.push_back(point.key);
  experiment.measure = [&](std::size_t row) {
    return CsvRow(SweepValues(grid.points[row], {grid.floor, grid.limit}));
  };
  return CompleteTable(experiment, command.output);
}

}  // namespace seam
