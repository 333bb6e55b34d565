/// Loads that fall on taut bridges: energy out of nothing, open joints, and the cost beside stock's
/// iterative joints in the same run.

#include "tests/support/mechanisms/taut_bridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tests/lab/world/bench.h"

namespace seam {
namespace {

constexpr double kBridgeSeconds = 2;

void RunBridge(TautBridge bridge, const char* joints) {
  bridge.joints = joints;
  const auto world = TautBridgeWorld(bridge);
  const double ticks = kBridgeSeconds * world->scene().solver.tick_hz;
  for (int tick = 0; tick < ticks; ++tick) world->Step();
}

/// All loads and drops for one number of planks and of substeps.
std::vector<std::string> RowOf(int planks, int substeps, int pairs) {
  double gained = 0, gap = 0;
  std::vector<double> costs;
  for (const double load : {1.0, 10.0, 40.0, 100.0}) {
    for (const double drop : {0.0, 0.03, 0.3, 1.0}) {
      TautBridge bridge;
      bridge.planks = planks;
      bridge.load = load;
      bridge.drop = drop;
      bridge.substeps = substeps;
      const BridgeCourse course = FollowBridge(TautBridgeWorld(bridge).get(), kBridgeSeconds);
      gained = std::max(gained, course.gained / std::max(course.released, 1e-9));
      gap = std::max(gap, course.gap);
      costs.push_back(CostRatio([&] { RunBridge(bridge, "iterative"); },
                                [&] { RunBridge(bridge, "auto"); }, pairs));
    }
  }
  std::sort(costs.begin(), costs.end());
  return {std::to_string(planks),
          std::to_string(substeps),
          fmt::format("{:.1f} %", 100 * gained),
          Digits(gap),
          fmt::format("{:.2f} x", costs[costs.size() / 2]),
          fmt::format("{:.2f} x", costs.back())};
}

}  // namespace

TextTable TautBridgeBench(bool quick) {
  TextTable table;
  table.name = "world-taut-bridge";
  table.title = "Loads that fall on a taut bridge";
  table.header = {"planks",          "joint_substeps", "energy gained",
                  "joints apart, m", "cost",           "at most"};
  const std::vector<int> all_planks =
      quick ? std::vector<int>{10, 60} : std::vector<int>{10, 20, 40, 60, 100};
  const std::vector<int> all_substeps =
      quick ? std::vector<int>{1, 2} : std::vector<int>{1, 2, 3, 4, 6};
  for (const int planks : all_planks) {
    for (const int substeps : all_substeps) {
      table.rows.push_back(RowOf(planks, substeps, quick ? 1 : 3));
    }
  }
  table.note =
      "1, 10, 40 and 100 kg from 0, 3, 30 and 100 cm, 2 s each; planks of 0.2 kg and 1 m. Gained: "
      "the most energy above that at the beginning, as a share of that of the fall. Gained and "
      "apart: the worst of all; cost: as a ratio to iterative joints, in the median and at most.";
  table.command = std::string("seam-lab world taut-bridge") + (quick ? " --quick" : "");
  return table;
}

}  // namespace seam
