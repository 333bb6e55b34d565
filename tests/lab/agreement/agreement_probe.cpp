#include "tests/lab/agreement/agreement.h"
#include "tests/lab/experiment/probes.h"
#include "tests/lab/session.h"

namespace seam {
namespace {

struct Agreed {
  double longest_s = 0;
  std::string body;
  double differed_share = 0;
  std::int64_t deferred = 0;
};

Values AgreementValues(const Agreed& a) {
  return Judged("", {Decimals("longest_s", a.longest_s, 3),
                     {"body", a.body},
                     Decimals("differed_share", a.differed_share, 5),
                     Count("replays_deferred", a.deferred)});
}

Values MeasureAgreement(const ProbeRun& run) {
  ClusterConfig config = Configure(run.settings);
  config.keep = false;
  Cluster cluster(config);
  AgreementWatch watch(cluster);
  cluster.each_instant = [&watch] { watch.Look(); };
  cluster.Run();
  RequireScripts(cluster.server());
  if (watch.compared() == 0) throw OperatorError("no two peers simulate the same body");
  const double share =
      static_cast<double>(watch.differed()) / static_cast<double>(watch.compared());
  return AgreementValues({watch.longest_s(), watch.body(), share, cluster.replays_deferred()});
}

void AddAgreementFlags(Command& agreement, ProbeOptions& options) {
  agreement.Option("SCENES", options.scenes, "scene files or names").Required();
  AddTableFlag(agreement, options.output).Required();
  AddSessionFlags(agreement, options);
  AddRunFlags(agreement, options.output, "runs at a time (default: 1)");
}

}  // namespace

Probe AgreementProbe() {
  Probe probe;
  probe.command = "agreement";
  probe.about = "how long peers differ that know all inputs";
  probe.flags = AddAgreementFlags;
  probe.defaults.output.jobs = 1;
  probe.key = {"version", "scene", "scene_hash", "network", "seed"};
  probe.axes = {NetworkAxis(), SeedAxis()};
  probe.columns = AgreementValues({});
  probe.measure = MeasureAgreement;
  return probe;
}

}  // namespace seam
