/// What is nothing to a peer, and who has what: the costs that must not grow with the room.

#include "tests/lab/relief/bar_rows.h"
#include "tests/lab/relief/benches.h"

namespace seam {

TextTable ReliefConcernBench(bool quick) {
  const int far = quick ? 1000 : 10000, ticks = quick ? 120 : 600, pairs = quick ? 3 : 9;
  const int repeats = quick ? 5 : 51;
  const auto plan = [&](float width, float height) {
    return PlanMs(256, 1000, width, height, repeats);
  };
  std::vector<BarRow> rows;
  rows.push_back(AtMost("a body without relevance to a client, a tick",
                        FarBodyNs(far, ticks, pairs), 2, "ns",
                        std::to_string(far) + " of them beside few"));
  rows.push_back(AtMost("a plan, 256 players in a row, 1000 bodies that move", plan(7680, 20), 0.5,
                        "ms", "30 m apart"));
  rows.push_back(AtMost("the same seen from above", plan(1500, 1500), 0.5, "ms", "1500 m wide"));
  rows.push_back(Printed("the same, crowded", Digits(plan(100, 20)) + " ms (100 m wide)"));
  return TableOf("concern", "What is relevant to nobody, and who has what", rows,
                 "CPU time, medians. Plans come ten times a second.");
}

}  // namespace seam
