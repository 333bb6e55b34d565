#include "tests/lab/experiment/probes.h"
#include "tests/lab/session.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {
namespace {

Values DamageValues(const AuthoritySource::ReportCounts& counts, std::int64_t states) {
  const auto judged = static_cast<double>(counts.accepted + counts.implausible);
  const double share = judged > 0 ? static_cast<double>(counts.accepted) / judged : 1;
  return Judged("", {Count("accepted", counts.accepted), Count("implausible", counts.implausible),
                     Decimals("accepted_share", share, 4), Count("changed", counts.changed),
                     Count("repeated", counts.repeated), Count("refused_states", states)});
}

Values MeasureDamage(const ProbeRun& run) {
  ClusterConfig config = Configure(run.settings);
  config.keep = false;
  Cluster cluster(config);
  cluster.Run();
  RequireScripts(cluster.server());
  const AuthoritySource* const source = ServerTestAccess::RuleSourceOf(cluster.server());
  if (source == nullptr) throw OperatorError("nothing in this scene can be hurt");
  const AuthoritySource::ReportCounts& counts = source->counts();
  return DamageValues(counts, cluster.server().stats().dropped_implausible - counts.implausible);
}

void AddDamageFlags(Command& damage, ProbeOptions& options) {
  damage.Option("SCENES", options.scenes, "scene files or names, of parts with health").Required();
  AddTableFlag(damage, options.output).Required();
  AddSessionFlags(damage, options);
  AddRunFlags(damage, options.output, "runs at a time (default: 1)");
}

}  // namespace

Probe DamageProbe() {
  Probe probe;
  probe.command = "damage";
  probe.about = "does the server believe honest impacts?";
  probe.flags = AddDamageFlags;
  probe.defaults.output.jobs = 1;
  probe.key = {"version", "scene", "scene_hash", "network", "seed"};
  probe.axes = {NetworkAxis(), SeedAxis()};
  probe.columns = DamageValues({}, 0);
  probe.measure = MeasureDamage;
  return probe;
}

}  // namespace seam
