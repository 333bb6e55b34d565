#include "tests/lab/experiment/probes.h"
#include "tests/lab/load/load.h"

namespace seam {
namespace {

Values LoadValues(const SessionLoad& load) {
  return Judged("", {Count("players", load.players), Count("bodies", load.bodies),
                     Decimals("awake", load.awake, 1), Decimals("stepped", load.stepped, 1),
                     Decimals("server_us_per_tick", load.server_us, 1),
                     Decimals("server_p99_us", load.server_p99_us, 1),
                     Decimals("client_us_per_tick", load.client_us, 1),
                     Decimals("to_client_kb_per_s", load.to_client_kbps, 2),
                     Decimals("from_client_kb_per_s", load.from_client_kbps, 2),
                     Decimals("held_share", load.held_share, 4),
                     Decimals("split_share", load.split_share, 4)});
}

void AddLoadFlags(Command& load, ProbeOptions& options) {
  load.Option("SCENES", options.scenes, "scene files or names").Required();
  AddTableFlag(load, options.output).Required();
  load.Option("--methods", options.methods, "buffer, central/own, ... (default: both sides)")
      .CommaSeparated();
  AddSessionFlags(load, options);
  AddRunFlags(load, options.output, "runs at a time (default: 1; more blur CPU times)");
}

}  // namespace

Probe LoadProbe() {
  Probe probe;
  probe.command = "load";
  probe.about = "what sessions cost the server and a client";
  probe.flags = AddLoadFlags;
  probe.defaults.methods = {"buffer", "central/all"};
  probe.defaults.output.jobs = 1;  // more disturb each other's CPU times
  probe.key = {"version", "scene", "scene_hash", "method", "network", "seed"};
  // Methods of one scene and seed one after the other: they are compared.
  probe.axes = {NetworkAxis(), SeedAxis(), MethodAxis()};
  probe.columns = LoadValues({});
  probe.measure = [](const ProbeRun& run) {
    return LoadValues(MeasureLoad(Configure(run.settings)));
  };
  return probe;
}

}  // namespace seam
