#include "common/base/process.h"
#include "tests/lab/commands.h"
#include "tests/lab/grid.h"
#include "tests/lab/rows.h"
#include "tests/lab/sweep_row.h"

namespace seam {

int RunSweep(const SweepCommand& command) {
  const Grid grid = ReadGrid(command.file);
  std::vector<std::string> keys;
  for (const GridPoint& point : grid.points) keys.push_back(point.key);
  SweepTable table(command.table, SweepHeader(), kGridColumns, keys, command.force);
  StopOnSignals();
  RowMaker maker;
  maker.make = [&](std::size_t row) {
    return SweepRow(grid.points[row], {grid.floor, grid.limit});
  };
  const RowsDone done = MakeRows(keys, MissingRows(table, keys.size()), maker, JobsOr(command.jobs),
                                 command.quiet, &table);
  return PrintRows(command.table, table, keys.size(), done);
}

}  // namespace seam
