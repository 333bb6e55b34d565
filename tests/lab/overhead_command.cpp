#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "common/base/find_scene.h"
#include "common/base/process.h"
#include "common/measure/table.h"
#include "tests/lab/commands.h"
#include "tests/lab/grid.h"
#include "tests/lab/hard/overhead.h"
#include "tests/lab/sweep_table.h"

namespace seam {
namespace {

const char* const kHeader = "scene,bodies,raw_us_per_step,core_us_per_step,ratio,valid";

/// The scene's duration, or less of it where there is much to simulate.
int TicksFor(const Scene& scene) {
  const double whole = scene.duration_s * scene.solver.tick_hz;
  const double bodies = static_cast<double>(scene.parts.size());
  return static_cast<int>(std::min(whole, 600000 / std::max(100.0, bodies)));
}

}  // namespace

int RunOverhead(const OverheadCommand& command) {
  std::vector<Scene> scenes;
  std::vector<std::string> keys;
  for (const std::string& path : command.scenes) {
    scenes.push_back(LoadScene(FindScene(path)));
    keys.push_back(CsvField(path));
  }
  std::unique_ptr<SweepTable> table;
  if (!command.table.empty()) {
    table = std::make_unique<SweepTable>(command.table, kHeader, 1, keys, command.force);
  }
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
    if (!table) continue;
    if (!o.equal) {
      table->Add(i, keys[i] + ",,,,,core and raw Box2D end differently");
      continue;
    }
    table->Add(i, fmt::format("{},{},{:.4g},{:.4g},{:.4f},", keys[i], o.bodies, o.raw_us_per_step,
                              o.core_us_per_step, o.ratio()));
  }
  return equal && g_stop == 0 ? 0 : 1;
}

}  // namespace seam
