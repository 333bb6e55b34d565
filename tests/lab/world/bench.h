#pragma once
/// Costs and errors of what a scene may contain, each beside its baseline in the same run:
/// seam-lab world NAME. One file per bench.

#include <functional>
#include <string>
#include <vector>

#include "tests/lab/report/text_table.h"

namespace seam {

struct Bench {
  const char* name;              ///< a-z, 0-9, -
  TextTable (*run)(bool quick);  ///< quick: fewer bodies and repeats, seconds in all
};

/// All of them, in the order of the report.
const std::vector<Bench>& WorldBenches();

// Each in its own file tests/lab/world/NAME.cpp, and named in benches.cpp.
TextTable FeatherweightBench(bool quick);
TextTable AnchoredBench(bool quick);
TextTable WaterBench(bool quick);
TextTable AssemblyBench(bool quick);
TextTable GroupingBench(bool quick);
TextTable GroupingMovingBench(bool quick);
TextTable JointsBench(bool quick);
TextTable TautBridgeBench(bool quick);
TextTable CharactersBench(bool quick);
TextTable FactorBench(bool quick);
TextTable PlannerBench(bool quick);
TextTable ClientTickBench(bool quick);

/// CPU time of one plan of a room so wide and high, m, in which all moves, ms: the median of some.
double PlanMs(int players, int mechanisms, float width, float height, int repeats);
/// Cost of a client's tick for each of so many bodies without relevance to it, ns.
double FarBodyNs(int far, int ticks, int pairs);

/// CPU seconds of this process so far.
double CpuSeconds();

/// What `b` costs beside `a`: the two take turns `pairs` times; the median of the pairs' ratios of
/// CPU time. Both run once before, uncounted. Requires pairs >= 1.
double CostRatio(const std::function<void()>& a, const std::function<void()>& b, int pairs);

}  // namespace seam
