/// Glue on anchored parts breaks in a session as it does in one world.

#include <gtest/gtest.h>

#include <string>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "common/sync/edits/edit_order.h"
#include "tests/cluster/anchored_scenes.h"

namespace seam {
namespace anchored_glue_test {

ClusterConfig Session(const std::string& scene, const std::string& mode,
                      const std::string& impair) {
  ClusterConfig config;
  config.scene = "anchored";
  config.scene_text = scene;
  config.mode = mode;
  config.impair = impair;
  return config;
}

/// Ticks of the ordered breaks.
std::vector<std::int64_t> Breaks(const Recording& recording) {
  std::vector<std::int64_t> ticks;
  for (const auto& [number, order] : recording.edits) {
    if (ToEdit(order).As<BreakEdit>() != nullptr) ticks.push_back(order.tick);
  }
  return ticks;
}

TEST(AnchoredGlue, AShelfBreaksOffAtTheOraclesTickInEveryModeOnEveryNetwork) {
  const std::vector<std::int64_t> alone = Breaks(RunCluster(Session(kShelf, "oracle", "perfect")));
  ASSERT_EQ(alone.size(), 1u);
  for (const char* mode : {"buffer", "central", "strict"}) {
    for (const char* impair : {"perfect", "4g", "terrible", "delay=200ms"}) {
      EXPECT_EQ(Breaks(RunCluster(Session(kShelf, mode, impair))), alone) << mode << " " << impair;
    }
  }
  ClusterConfig own = Session(kShelf, "central", "4g");
  own.predict = "own";
  EXPECT_EQ(Breaks(RunCluster(own)), alone);
}

/// A body's last place in any peer's view, against the oracle's, m.
double Farthest(const Recording& recording, const Oracle& oracle) {
  double farthest = 0;
  for (const auto& [peer, views] : recording.views) {
    const auto& [tick, view] = *views.rbegin();
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      const std::optional<BodyState> truth = oracle.At(tick, view.id[i]);
      if (!truth) return 1e9;
      const Vec2 at(view.x[i], view.y[i]);
      farthest = std::max(farthest, static_cast<double>((at - truth->position).norm()));
    }
  }
  return farthest;
}

TEST(AnchoredGlue, AWallOnAFoundationFallsOnEveryScreen) {
  for (const char* impair : {"perfect", "4g"}) {
    const Recording recording = RunCluster(Session(kFoundation, "buffer", impair));
    const Oracle oracle = ComputeOracle(recording, WithBarriers(recording.room));
    EXPECT_GE(oracle.edits.size(), 40u);
    EXPECT_EQ(recording.edits.size(), oracle.edits.size()) << impair;
    EXPECT_LT(Farthest(recording, oracle), 0.5) << impair;
  }
}

/// The server breaks nothing because it assumes that a ball flies on, which its player has stopped.
TEST(AnchoredGlue, ABallThatIsStoppedInTimeBreaksNothing) {
  for (const char* impair : {"perfect", "delay=200ms", "delay=150ms,loss=10%"}) {
    const Recording recording = RunCluster(Session(kStopped, "buffer", impair));
    const Oracle oracle = ComputeOracle(recording, WithBarriers(recording.room));
    ASSERT_EQ(oracle.edits.size(), 0u);
    EXPECT_EQ(recording.edits.size(), 0u) << impair;
  }
}

/// Only in mode strict does a client's word count: it must have something that it can strike with.
TEST(AnchoredGlue, AClientBreaksAnchoredGlueOnlyWhereTheServerFeelsNothing) {
  for (const auto& [mode, right] : {std::pair("strict", true), std::pair("buffer", false)}) {
    const Scene scene = ParseScene(kShelf, "shelf.toml");
    const SyncConfig config = MakeSyncConfig(mode, "");
    Replica replica(scene, config, 0, -1);
    AuthorityManager authority(scene, config, replica);
    EditLog log(replica.world(), authority, 60);
    EditOrder proposal = ToOrder(Edit(BreakEdit{0}));
    proposal.number = -1;
    EXPECT_EQ(log.Propose(1, proposal), EditLog::Verdict::kNoRight) << "it has nothing";
    AuthorityRecord record = replica.authority().at(0);
    record.authority = 1;
    replica.authority().Set(0, record);
    const EditLog::Verdict verdict = log.Propose(1, proposal);
    EXPECT_EQ(verdict, right ? EditLog::Verdict::kTaken : EditLog::Verdict::kNoRight) << mode;
  }
}

}  // namespace anchored_glue_test
}  // namespace seam
