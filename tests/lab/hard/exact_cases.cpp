#include <algorithm>

#include "tests/lab/hard/exact_judge.h"

namespace seam {

std::vector<HardCase> ExactCases() {
  std::vector<HardCase> all;
  for (const auto& list :
       {ChainCases(), CollisionCases(), CradleCases(), FlightCases(), FrictionCases(),
        LinkageCases(), PendulumCases(), ToppleCases(), TunnelCases()}) {
    all.insert(all.end(), list.begin(), list.end());
  }
  std::sort(all.begin(), all.end(),
            [](const HardCase& a, const HardCase& b) { return a.name < b.name; });
  return all;
}

}  // namespace seam
