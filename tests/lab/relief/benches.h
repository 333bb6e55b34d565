#pragma once
/// Benches of the load that distribution takes off the server, and of its cost: seam-lab relief
/// NAME. One file per bench, each a table of rows.

#include <vector>

#include "tests/lab/world/bench.h"

namespace seam {

/// All of them, in the order of the report.
const std::vector<Bench>& ReliefBenches();

TextTable ReliefServerBench(bool quick);
TextTable ReliefGrowthBench(bool quick);
TextTable ReliefConcernBench(bool quick);
TextTable ReliefHandOverBench(bool quick);
TextTable ReliefVanishBench(bool quick);
TextTable ReliefThrottleBench(bool quick);
TextTable ReliefUdpBench(bool quick);

}  // namespace seam
