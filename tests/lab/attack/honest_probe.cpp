#include "server/trust/trust_ladder.h"
#include "tests/lab/attack/honest.h"
#include "tests/lab/experiment/probes.h"

namespace seam {
namespace {

Values HonestValues(const HonestOutcome& o) {
  return Judged("", {Count("judged", o.judged),
                     Count("by_copy", o.by_copy),
                     Count("doubted", o.doubted),
                     Count("refused", o.refused),
                     {"step", ToString(static_cast<TrustStep>(o.step))},
                     Decimals("score", static_cast<double>(o.score), 2),
                     Decimals("drift", static_cast<double>(o.drift), 3),
                     Count("audited", o.audited),
                     Count("audit_steps", o.steps),
                     Decimals("audit", o.audit, 3),
                     Count("breaks_refused", o.breaks_refused),
                     Count("impacts_accepted", o.impacts_accepted),
                     Count("impacts_refused", o.impacts_refused)});
}

Values MeasureHonest(const ProbeRun& run) {
  return HonestValues(RunHonest(Configure(run.settings), run.key.at("views") == "shown"));
}

void AddHonestFlags(Command& trust, ProbeOptions& options) {
  trust.Option("SCENES", options.scenes, "scene files or names").Required();
  AddTableFlag(trust, options.output).Required();
  trust.Option("--method", options.methods, "buffer | strict ...; repeatable (default: buffer)");
  trust.Option("--views", options.views, "shown: the server simulates all bodies; hidden: few")
      .OneOf({"shown", "hidden"});
  trust.Option("--impair", options.networks, "profile's name or list; repeatable (default: demo)");
  trust.Option("--drive", options.drive, "script | bot").OneOf({"script", "bot"});
  trust.Option("--seconds", options.seconds, "after tick 0 (default: the scene's own)")
      .Range(0.0, kDurationMax);
  trust.Option("--seeds", options.seeds, "from 1 (default: 1)").Range(1, 10000);
  AddRunFlags(trust, options.output, "runs at a time (default: 1)");
}

}  // namespace

Probe HonestProbe() {
  Probe probe;
  probe.command = "trust";
  probe.about = "does the server doubt honest clients?";
  probe.flags = AddHonestFlags;
  probe.defaults.output.jobs = 1;
  probe.key = {"version", "scene", "scene_hash", "method", "views", "drive", "network", "seed"};
  probe.axes = {MethodAxis(), ViewsAxis(), DriveAxis(), NetworkAxis(), SeedAxis()};
  probe.columns = HonestValues({});
  probe.measure = MeasureHonest;
  return probe;
}

}  // namespace seam
