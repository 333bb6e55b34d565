#include <cstdio>

#include "common/sync/blend/reconcile.h"
#include "tests/lab/experiment/probes.h"
#include "tests/lab/fairness/fairness.h"
#include "tests/lab/report/sessions/fairness_section.h"
#include "tests/lab/report/validity.h"

namespace seam {
namespace {

std::vector<std::string> AllMethods() {
  std::vector<std::string> methods = {"oracle", "central", "strict"};
  for (const NamedReconciler& rule : Reconcilers()) {
    methods.push_back(std::string("buffer/") + rule.name);
  }
  return methods;
}

Values FairnessValues(const FairnessResult& r) {
  return Judged(r.invalid, {Count("crash_tick", r.crash), Significant("closing_mps", r.closing_mps),
                            Significant("momentum_oracle_ns", r.oracle_ns),
                            Significant("momentum_near_own_ns", r.own_ns[0]),
                            Significant("momentum_far_own_ns", r.own_ns[1]),
                            Significant("momentum_near_server_ns", r.server_ns[0]),
                            Significant("momentum_far_server_ns", r.server_ns[1]),
                            Significant("advantage_own_ns", r.advantage_own_ns()),
                            Significant("advantage_server_ns", r.advantage_server_ns())});
}

Values MeasureFairness(const ProbeRun& run) {
  FairnessRun crash;
  crash.session = run.settings;
  crash.near = run.key.at("near") == run.scene->players.at(0).name ? 0 : 1;
  crash.near_path = run.key.at("near_path");
  crash.far_path = run.key.at("far_path");
  crash.random = run.key.at("drive") == "random";
  return FairnessValues(RunFairness(crash));
}

/// Prints the tables for people. Status 1: too many rows are not valid.
int PrintFairness(const std::string& path) {
  const CsvTable csv = CsvTable::Load(path);
  for (const char* drive : {"script", "random"}) {
    const TextTable shown = FairnessTable(csv, drive, "seam-lab fairness -o " + path);
    std::printf("\n%s\n\n%s", shown.title.c_str(), Markdown(shown).c_str());
  }
  const Validity validity = FindValidity(csv);
  if (!validity.too_many()) return 0;
  std::fprintf(stderr, "seam-lab: %s: %zu of %zu rows are not valid\n", path.c_str(),
               validity.invalid, validity.rows);
  return 1;
}

void AddFairnessFlags(Command& fairness, ProbeOptions& options) {
  AddTableFlag(fairness, options.output).Required();
  fairness.Option("--scene", options.scene, "two players' cars that meet (default: headon)");
  fairness.Option("--methods", options.methods, "strict, buffer/fade, ... (default: all)")
      .CommaSeparated();
  fairness.Option("--near", options.near_path, "the near player's network, either way");
  fairness.Option("--far", options.far_path, "the far player's network, either way");
  fairness.Option("--seeds", options.seeds, "from 1, each both ways round (default: 8)")
      .Range(1, 1000);
  AddRunFlags(fairness, options.output);
}

// Axes that only the key has; MeasureFairness reads them there.

ProbeAxis NearPathAxis() {
  return {"near_path", [](const ProbeOptions& options, const Scene&) {
            return std::vector<std::string>{options.near_path};
          }};
}

ProbeAxis FarPathAxis() {
  return {"far_path", [](const ProbeOptions& options, const Scene&) {
            return std::vector<std::string>{options.far_path};
          }};
}

ProbeAxis BothDrivesAxis() {
  return {"drive", [](const ProbeOptions&, const Scene&) {
            return std::vector<std::string>{"script", "random"};
          }};
}

/// The name of the player who is near.
ProbeAxis NearAxis() {
  return {"near", [](const ProbeOptions&, const Scene& scene) {
            return std::vector<std::string>{scene.players.at(0).name, scene.players.at(1).name};
          }};
}

}  // namespace

Probe FairnessProbe() {
  Probe probe;
  probe.command = "fairness";
  probe.about = "a mirrored crash between a near and a far player";
  probe.flags = AddFairnessFlags;
  probe.defaults.scene = "headon";
  probe.defaults.methods = AllMethods();
  probe.defaults.near_path = FairnessRun().near_path;
  probe.defaults.far_path = FairnessRun().far_path;
  probe.defaults.seeds = 8;
  probe.key = {"version",  "scene", "scene_hash", "method", "near_path",
               "far_path", "drive", "near",       "seed"};
  probe.axes = {NearPathAxis(), FarPathAxis(), BothDrivesAxis(),
                MethodAxis(),   SeedAxis(),    NearAxis()};
  probe.columns = FairnessValues({});
  probe.measure = MeasureFairness;
  probe.prepare = [](const std::string& word, ProbeRun* run) { run->key["scene"] = word; };
  probe.summary = PrintFairness;
  return probe;
}

}  // namespace seam
