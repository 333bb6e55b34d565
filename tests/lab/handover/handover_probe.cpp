#include "tests/lab/experiment/probes.h"
#include "tests/lab/handover/handover.h"

namespace seam {
namespace {

Values HandOverValues(const HandOvers& h) {
  return Judged(
      "", {Count("clients", h.clients), Count("mechanisms", h.mechanisms),
           Decimals("changes_per_s", h.per_s, 1), Decimals("dropped_per_s", h.dropped_per_s, 1),
           Decimals("wish_p50_ms", h.p50_ms, 0), Decimals("wish_p99_ms", h.p99_ms, 0),
           Decimals("wish_max_ms", h.max_ms, 0), Decimals("gap_p95_m", h.gap_p95_m, 4),
           Decimals("gap_p95_mps", h.gap_p95_mps, 4), Count("compared", h.compared),
           Decimals("none_share", h.none_share, 4), Count("unsimulated_ticks", h.unsimulated),
           Count("several", h.several), Decimals("grants_kb_per_s", h.grants_kbps, 3),
           Decimals("to_client_kb_per_s", h.to_client_kbps, 2)});
}

void AddHandOverFlags(Command& hand_over, ProbeOptions& options) {
  hand_over.Option("SCENES", options.scenes, "scene files or names").Required();
  AddTableFlag(hand_over, options.output).Required();
  hand_over.Option("--players", options.players, "the first so many join (default: all)")
      .Range(0, kPlayersMax);
  AddSessionFlags(hand_over, options);
  AddRunFlags(hand_over, options.output, "runs at a time (default: 1)");
}

}  // namespace

Probe HandOverProbe() {
  Probe probe;
  probe.command = "hand-over";
  probe.about = "how long changes of authority take";
  probe.flags = AddHandOverFlags;
  probe.defaults.output.jobs = 1;
  probe.key = {"version", "scene", "scene_hash", "players", "network", "seed"};
  probe.axes = {PlayersAxis(), NetworkAxis(), SeedAxis()};
  probe.columns = HandOverValues({});
  probe.measure = [](const ProbeRun& run) {
    return HandOverValues(MeasureHandOvers(Configure(run.settings)));
  };
  return probe;
}

}  // namespace seam
