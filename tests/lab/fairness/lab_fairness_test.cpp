/// seam-lab fairness: its crash, its arithmetic, and the network that it gives each player.

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/net/memory.h"
#include "common/sync/inputs/input_source.h"
#include "tests/lab/experiment/probes.h"
#include "tests/lab/fairness/fairness.h"
#include "tests/lab/fairness/lagging_net.h"
#include "tests/lab/fairness/mirrored_script.h"
#include "tests/lab/report/sessions/fairness_section.h"
#include "tests/lab/report/validity.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_fairness_test {

FairnessRun Headon(const std::string& mode, const std::string& reconcile = "") {
  FairnessRun run;
  run.session.scene = "scenes/headon.toml";
  run.session.mode = mode;
  run.session.reconcile = reconcile;
  run.session.duration_s = 2.5;
  return run;
}

TEST(Fairness, InModeOracleBothReceiveTheImpulseOfMechanics) {
  for (const int near : {0, 1}) {
    FairnessRun run = Headon("oracle");
    run.near = near;
    const FairnessResult r = RunFairness(run);
    ASSERT_EQ(r.invalid, "");
    // Two of 7.14 kg that end at rest: each loses half of the closing speed. The motors, which pull
    // for half a second more, are in it with less than 20 N each.
    EXPECT_NEAR(r.oracle_ns, 7.14 * r.closing_mps / 2, 7.14 * 2.9 * 0.2);
    for (const int side : {0, 1}) {
      const auto i = static_cast<std::size_t>(side);
      EXPECT_NEAR(r.own_ns[i], r.oracle_ns, 0.01);
      EXPECT_NEAR(r.server_ns[i], r.oracle_ns, 0.01);
    }
  }
}

TEST(Fairness, TheNearSideOnlySwapsTheTwoCars) {
  ClusterConfig config;
  config.scene = "headon";
  config.reconcile = "snap";
  config.duration_s = 2.5;
  const Recording recording = RunCluster(config);
  const FairnessResult a = JudgeFairness(recording, 0), b = JudgeFairness(recording, 1);
  ASSERT_EQ(a.invalid, "");
  EXPECT_NE(a.own_ns[0], a.own_ns[1]);
  EXPECT_EQ(a.own_ns[0], b.own_ns[1]);
  EXPECT_EQ(a.own_ns[1], b.own_ns[0]);
  EXPECT_EQ(a.server_ns[0], b.server_ns[1]);
  EXPECT_DOUBLE_EQ(a.advantage_own_ns(), -b.advantage_own_ns());
}

TEST(Fairness, InModeStrictBothReceiveTheImpulseOfAWall) {
  // Mode strict places the other car at its received pose, immovable: each receives the impulse of
  // a wall.
  const FairnessResult r = RunFairness(Headon("strict"));
  ASSERT_EQ(r.invalid, "");
  EXPECT_GT(r.own_ns[0], 1.5 * r.oracle_ns);
}

TEST(Fairness, ARunWithoutTheCrashOrItsEndIsNotValid) {
  FairnessRun run = Headon("buffer");
  run.session.duration_s = 1;
  EXPECT_EQ(RunFairness(run).invalid, "the cars did not meet");
  run.session.duration_s = 1.6;
  EXPECT_EQ(RunFairness(run).invalid, "views about the crash are missing");
}

TEST(Fairness, NeedsTwoPlayersWithAVehicleEach) {
  FairnessRun run = Headon("buffer");
  run.session.scene = "scenes/relay.toml";
  run.session.duration_s = 0.5;
  EXPECT_THROW(RunFairness(run), OperatorError);
  run.session.scene = "scenes/scrum.toml";
  EXPECT_THROW(RunFairness(run), OperatorError);
}

TEST(Fairness, BothFollowOneBotAndStayMirrorImages) {
  for (const char* name : {"headon", "seesaw"}) {  // scripts of one line and of several
    const Scene scene = LoadScene("scenes/" + std::string(name) + ".toml");
    const Scene same = ParseScene(WithMirroredBots(scene, 7, 4), "mirrored.toml");
    ASSERT_EQ(same.parts.size(), scene.parts.size());
    for (std::int64_t tick = 0; tick <= 240; ++tick) {
      for (const int player : {0, 1}) {
        ASSERT_TRUE(ScriptedInput(same, player, tick) == BotInput(7, 0, tick, 60)) << tick;
      }
    }
  }
  FairnessRun run = Headon("oracle");
  run.random = true;
  run.session.seed = 3;
  const FairnessResult r = RunFairness(run);
  ASSERT_EQ(r.invalid, "");
  EXPECT_NEAR(r.own_ns[0], r.own_ns[1], 0.02 * r.oracle_ns);
  EXPECT_LT(r.closing_mps, 30) << "slower than at full throttle";
}

TEST(Fairness, EachPlayersPathIsSlowBothWays) {
  MemoryNetwork network;
  const Address here{1, 1}, there{2, 2};
  LaggingNet lagging(network.Attach(here), "delay=20ms", 1);
  const std::unique_ptr<Net> other = network.Attach(there);
  const auto come = [](Net* net, std::int64_t now_us) {
    Address from;
    Bytes datagram;
    net->Advance(now_us);
    return net->Receive(&from, &datagram);
  };
  const Bytes datagram = {1, 2, 3};
  lagging.Advance(0);
  lagging.Send(there, datagram);
  lagging.Flush();
  EXPECT_FALSE(come(other.get(), 0));
  lagging.Advance(20001);
  lagging.Flush();
  EXPECT_TRUE(come(other.get(), 20001));
  other->Send(here, datagram);
  other->Flush();
  EXPECT_FALSE(come(&lagging, 20002));
  EXPECT_FALSE(come(&lagging, 39000));
  EXPECT_TRUE(come(&lagging, 40100));
}

const char* const kColumns =
    "version,scene,scene_hash,method,near_path,far_path,drive,near,seed,valid,crash_tick,closing_"
    "mps,"
    "momentum_oracle_ns,momentum_near_own_ns,momentum_far_own_ns,momentum_near_server_ns,"
    "momentum_far_server_ns,advantage_own_ns,advantage_server_ns\n";

TEST(FairnessTable, HasMeansAndThe95thPercentileAndNamesInvalidRows) {
  const std::string key = "v,headon,0,";
  const std::string paths = ",delay=20ms,delay=120ms,script,ann,1,";
  const CsvTable csv =
      CsvTable::Parse(kColumns + key + "strict" + paths + ",87,30,100,100,104,100,98,4,-2\n" + key +
                          "strict" + paths + ",87,30,100,100,94,100,102,-6,2\n" + key +
                          "buffer/fade" + paths + "the cars did not meet,,,,,,,,,\n",
                      "fairness.csv");
  EXPECT_EQ(FindValidity(csv).invalid, 1u);
  const TextTable table = FairnessTable(csv, "script", "seam-lab fairness");
  ASSERT_EQ(table.rows.size(), 2u);
  const std::vector<std::string> strict = {"strict", "2", "100", "100 / 99", "−1", "6", "+0", "2"};
  EXPECT_EQ(table.rows[0], strict);
  EXPECT_EQ(table.rows[1][2], "not valid: the cars did not meet");
  EXPECT_NE(table.note.find("Of all 3 rows 1 are not valid"), std::string::npos) << table.note;
}

TEST(FairnessCommand, WritesARowForEachSeedAndAssignmentAndResumes) {
  const LabWorkspace work;
  const Probe probe = FairnessProbe();
  ProbeOptions options = probe.defaults;
  options.methods = {"buffer/fade"};
  options.seeds = 1;
  options.output.table = work / "fairness.csv";
  options.output.jobs = 1;
  options.output.quiet = true;
  EXPECT_EQ(RunProbe(probe, options), 0);
  const std::string first = work.Read("fairness.csv");
  const CsvTable csv = CsvTable::Parse(first, "fairness.csv");
  ASSERT_EQ(csv.rows(), 4u);
  EXPECT_EQ(csv.Text(0, "near"), "ann");
  EXPECT_EQ(csv.Text(1, "near"), "bob");
  EXPECT_EQ(csv.Text(1, "drive"), "script");
  EXPECT_EQ(csv.Text(2, "drive"), "random");
  EXPECT_EQ(FindValidity(csv).invalid, 0u);
  EXPECT_EQ(RunProbe(probe, options), 0);
  EXPECT_EQ(work.Read("fairness.csv"), first);
  options.methods = {"buffer/none-such"};
  EXPECT_THROW(RunProbe(probe, options), OperatorError);
}

}  // namespace lab_fairness_test
}  // namespace seam
