#include <algorithm>
#include <cstdio>
#include <memory>

#include "common/base/find_scene.h"
#include "common/base/process.h"
#include "tests/lab/commands.h"
#include "tests/lab/experiment/experiment.h"
#include "tests/lab/experiment/values.h"
#include "tests/lab/hard/overhead.h"

namespace seam {
namespace {

Values OverheadValues(const Overhead& o) {
  const Values values = {
      Count("bodies", o.bodies), Significant("raw_us_per_step", o.raw_us_per_step, 4),
      Significant("core_us_per_step", o.core_us_per_step, 4), Decimals("ratio", o.ratio(), 4)};
  Values row = o.equal ? values : Emptied(values);
  row.push_back({"valid", o.equal ? "" : "core and raw Box2D end differently"});
  return row;
}

/// The scene's duration, or less of it where there is much to simulate.
int TicksFor(const Scene& scene) {
  const double whole = scene.duration_s * scene.solver.tick_hz;
  const double bodies = static_cast<double>(scene.parts.size());
  return static_cast<int>(std::min(whole, 600000 / std::max(100.0, bodies)));
}

}  // namespace

int RunOverhead(const OverheadCommand& command) {
  std::vector<Scene> scenes;
  Experiment experiment;
  experiment.key_columns = "scene";
  experiment.value_columns = CsvColumns(OverheadValues({}));
  for (const std::string& path : command.scenes) {
    scenes.push_back(LoadScene(FindScene(path)));
    experiment.keys.push_back(CsvRow(std::vector<std::string>{path}));
  }
  std::unique_ptr<ResultTable> table;
  if (!command.output.table.empty()) table = OpenTable(experiment, command.output);
  StopOnSignals();
  std::printf("%-26s %6s %11s %11s %7s\n", "scene", "bodies", "raw us", "core us", "ratio");
  bool equal = true;
  for (std::size_t i = 0; i < scenes.size() && g_stop == 0; ++i) {
    if (table && table->Has(i)) continue;  // an interrupted run's
    const Overhead o = MeasureOverhead(scenes[i], TicksFor(scenes[i]), command.repeats);
    equal = equal && o.equal;
    std::printf("%-26s %6d %11.4g %11.4g %7.3f%s\n", command.scenes[i].c_str(), o.bodies,
                o.raw_us_per_step, o.core_us_per_step, o.ratio(),
                o.equal ? "" : "  they end differently: not the same simulation");
    std::fflush(stdout);
    if (table) table->Add(i, experiment.keys[i] + ',' + CsvRow(OverheadValues(o)));
  }
  return equal && g_stop == 0 ? 0 : 1;
}

}  // namespace seam
