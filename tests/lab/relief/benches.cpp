#include "tests/lab/relief/benches.h"

namespace seam {

const std::vector<Bench>& ReliefBenches() {
  static const std::vector<Bench> benches = {
      {"server", ReliefServerBench},   {"growth", ReliefGrowthBench},
      {"concern", ReliefConcernBench}, {"hand-over", ReliefHandOverBench},
      {"vanish", ReliefVanishBench},   {"throttle", ReliefThrottleBench},
      {"udp", ReliefUdpBench},
  };
  return benches;
}

}  // namespace seam
