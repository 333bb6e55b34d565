#include <algorithm>
#include <ctime>

#include "tests/lab/world/bench.h"

namespace seam {

const std::vector<Bench>& WorldBenches() {
  static const std::vector<Bench> benches = {
      {"featherweight", FeatherweightBench},
      {"anchored", AnchoredBench},
      {"water", WaterBench},
      {"assembly", AssemblyBench},
      {"grouping", GroupingBench},
      {"grouping-moving", GroupingMovingBench},
      {"joints", JointsBench},
      {"taut-bridge", TautBridgeBench},
      {"characters", CharactersBench},
      {"factor", FactorBench},
      {"planner", PlannerBench},
      {"client-tick", ClientTickBench},
  };
  return benches;
}

double CpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double CostRatio(const std::function<void()>& a, const std::function<void()>& b, int pairs) {
  const auto cost = [](const std::function<void()>& run) {
    const double began = CpuSeconds();
    run();
    return CpuSeconds() - began;
  };
  a();
  b();
  std::vector<double> ratios;
  for (int pair = 0; pair < pairs; ++pair) {
    const double cost_a = cost(a);
    ratios.push_back(cost(b) / std::max(cost_a, 1e-9));
  }
  std::sort(ratios.begin(), ratios.end());
  return ratios[ratios.size() / 2];
}

}  // namespace seam
