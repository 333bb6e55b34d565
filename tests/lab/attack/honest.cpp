#include "tests/lab/attack/honest.h"

#include <algorithm>

#include "server/trust/auditor.h"
#include "tests/lab/session.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {

namespace {

/// Listens and keeps nothing.
class NoRecorder : public Recorder {
 public:
  void Publish(const std::string&, std::int64_t, ByteView) override {}
};

}  // namespace

HonestOutcome RunHonest(ClusterConfig config, bool shown) {
  NoRecorder recorder;
  config.keep = false;
  config.recorder = shown ? &recorder : nullptr;
  config.trust = TrustMode::kAct;
  Cluster cluster(config);
  HonestOutcome outcome;
  std::int64_t looked = -1;
  cluster.each_instant = [&] {
    const Server& server = cluster.server();
    if (!server.started() || server.tick() == looked) return;
    looked = server.tick();
    for (int p = 0; p < static_cast<int>(cluster.scene().players.size()); ++p) {
      outcome.step = std::max(outcome.step, static_cast<int>(server.ladder().step(p)));
      outcome.score = std::max(outcome.score, server.ladder().score(p));
    }
  };
  cluster.Run();
  RequireScripts(cluster.server());
  const Plausible& plausible = ServerTestAccess::PlausibleOf(cluster.server());
  const Plausible::Counts& counts = plausible.counts();
  outcome.drift = plausible.greatest_drift();
  outcome.judged = counts.judged;
  outcome.by_copy = counts.by_copy;
  outcome.doubted = counts.doubted;
  outcome.refused = counts.refused;
  if (const Auditor* const auditor = ServerTestAccess::AuditorOf(cluster.server())) {
    outcome.audited = auditor->counts().compared;
    outcome.steps = auditor->counts().steps;
    outcome.audit = auditor->counts().greatest;
  }
  outcome.breaks_refused = cluster.server().connections().loadless;
  const AuthoritySource* const source = ServerTestAccess::RuleSourceOf(cluster.server());
  if (source == nullptr) return outcome;
  outcome.impacts_accepted = source->counts().accepted;
  outcome.impacts_refused = source->counts().implausible;
  return outcome;
}

std::vector<std::uint64_t> HashesByTrust(
    ClusterConfig config, const std::function<void(const Server&, TrustMode)>& look) {
  std::vector<std::uint64_t> hashes;
  for (const TrustMode trust : {TrustMode::kOff, TrustMode::kWatch, TrustMode::kAct}) {
    config.trust = trust;
    Cluster cluster(config);
    cluster.Run();
    hashes.push_back(cluster.server().replica().world().Hash());
    if (look) look(cluster.server(), trust);
  }
  return hashes;
}

}  // namespace seam
