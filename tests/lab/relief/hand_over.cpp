/// How long changes of authority take, and what they do to bodies.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "tests/lab/handover/handover.h"
#include "tests/lab/relief/bar_rows.h"
#include "tests/lab/relief/benches.h"
#include "tests/lab/relief/relief_scene.h"

namespace seam {
namespace {

/// Of the network `demo`, in the mean.
constexpr double kRoundTripMs = 120;

struct HandOverCase {
  std::string name;
  std::string scene;  // of scenes/
  std::string text;   // instead, if not empty
  int players;
  Drive drive;
  bool bars;               // printed alone: crowds
  double per_s_min = 0.5;  // changes, or it says nothing
};

std::vector<HandOverCase> HandOverCases() {
  ReliefRoom row;
  row.players = 16;
  row.each = 15;
  row.spacing = 9;
  row.sleep = true;
  return {{"swarm, 256 players", "swarm", "", 256, Drive::kScript, true, 100},
          {"relay8", "relay8", "", 8, Drive::kScript, true},
          {"pile", "pile", "", 4, Drive::kBot, false},
          {"a crowd: 16 cars and 12 crates each in a row, 9 m apart", "relief", ReliefText(row), 16,
           Drive::kBot, false}};
}

}  // namespace

TextTable ReliefHandOverBench(bool quick) {
  const double seconds = quick ? 3 : 8;
  std::vector<BarRow> rows;
  for (const HandOverCase& of : HandOverCases()) {
    if (quick && of.players > 8) continue;
    ClusterConfig config;
    config.scene = of.scene;
    config.scene_text = of.text;
    config.players = of.players;
    config.drive = of.drive;
    config.impair = "demo";
    config.publish = Publish::kNone;
    config.keep = false;
    config.duration_s = seconds;
    const HandOvers h = MeasureHandOvers(config);
    const std::string given = fmt::format("{:.0f} changes/s (≥ {:.3g}), {} bodies compared",
                                          h.per_s, of.per_s_min, h.compared);
    const auto add = [&](BarRow row) {
      row.given = given;
      row.valid = h.per_s >= of.per_s_min && h.compared > 0;
      if (!of.bars) row.must.clear();
      rows.push_back(std::move(row));
    };
    const std::string& name = of.name;
    add(AtMost(name + ": from the wish to the authority, p99", h.p99_ms, kRoundTripMs + 150, "ms",
               fmt::format("median {:.0f}, longest {:.0f}", h.p50_ms, h.max_ms)));
    add(AtMost(name + ": ticks in which nobody simulated what somebody should",
               static_cast<double>(h.unsimulated), 0, "ticks"));
    add(AtMost(name + ": instants with two authorities", static_cast<double>(h.several), 0, ""));
    add(AtMost(name + ": jump, p95", 100 * h.gap_p95_m, 2, "cm"));
    add(AtMost(name + ": jump of velocity, p95", h.gap_p95_mps, 0.1, "m/s"));
  }
  return TableOf("hand-over", "Hand-overs", rows,
                 fmt::format("Sessions of {:.0f} s over `demo`, whose round trip is 120 ms in the "
                             "mean, one datagram of a hundred lost; watched at every virtual "
                             "instant. A jump is how far the successor's body is from the "
                             "predecessor's copy at the same tick; what is shown glides.",
                             seconds));
}

}  // namespace seam
