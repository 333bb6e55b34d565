/// The auditor finds liars where the server has no copies, and nobody else. docs/trust.md has the
/// figures of more scenes, networks and seeds.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "server/trust/auditor.h"
#include "server/trust/trust_ladder.h"
#include "tests/lab/attack/attack.h"
#include "tests/lab/attack/cheat.h"
#include "tests/lab/attack/honest.h"
#include "tests/support/soak.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {
namespace lab_audit_test {

/// A room of which the server simulates nothing that a client does.
ClusterConfig Uncopied(const std::string& impair, std::int64_t seed) {
  std::ifstream file("tests/lab/attack/trust.toml");
  ClusterConfig config;
  config.scene = "trust";
  config.scene_text.assign(std::istreambuf_iterator<char>(file), {});
  config.mode = "strict";
  config.impair = impair;
  config.seed = seed;
  config.drive = Drive::kBot;
  config.duration_s = 16;
  config.keep = false;
  return config;
}

/// A large room: 24 players among 2800 bodies.
ClusterConfig LargeRoom(std::int64_t seed) {
  ClusterConfig config;
  config.scene = "swarm";
  config.mode = "strict";
  config.players = 24;
  config.seed = seed;
  config.duration_s = 12;
  config.keep = false;
  return config;
}

TEST(Audit, AGrossLiarIsFoundWithoutACopyWithinFiveSeconds) {
  for (const char* attack : {"x1.2", "fly", "freeze", "tear", "spin", "vel10", "gain5", "pulse",
                             "part", "wheel", "gaps"}) {
    for (const char* impair : {"perfect", "4g", "terrible"}) {
      for (const int seed : SoakSeeds(1, 1)) {
        SCOPED_TRACE(std::string(attack) + " over " + impair);
        const AttackOutcome outcome = RunAttack(Uncopied(impair, seed), attack);
        EXPECT_GT(outcome.lies, 10);
        EXPECT_LT(ActedAfterS(outcome), 5);
        // Whom a liar's car strikes where the server does not have it may be noted, and audited
        // more.
        EXPECT_LE(outcome.others_step, static_cast<int>(TrustStep::kWatched));
      }
    }
  }
}

TEST(Audit, ASmallLieIsFoundWithoutACopyWithinHalfAMinute) {
  for (const char* attack : {"x1.05", "gain0.5"}) {
    for (const int seed : SoakSeeds(1, 1)) {
      SCOPED_TRACE(attack);
      ClusterConfig config = Uncopied("demo", seed);
      config.duration_s = 33;
      const AttackOutcome outcome = RunAttack(config, attack);
      EXPECT_LT(ActedAfterS(outcome), 30);
      EXPECT_EQ(outcome.others_step, 0);
    }
  }
}

TEST(Audit, ALiarInALargeRoomIsFound) {
  for (const char* attack : {"none", "x1.2", "freeze"}) {
    for (const int seed : SoakSeeds(1, 1)) {
      SCOPED_TRACE(attack);
      const AttackOutcome outcome = RunAttack(LargeRoom(seed), attack);
      EXPECT_EQ(outcome.others_step, 0);
      if (std::string(attack) == "none") {
        EXPECT_EQ(outcome.step, 0);
      } else {
        EXPECT_LT(ActedAfterS(outcome), 5);
      }
    }
  }
}

TEST(Audit, HonestClientsWithoutCopiesAreFarFromALie) {
  struct Case {
    const char *scene, *impair, *method, *reconcile;
  };
  const Case cases[] = {{"crossing", "terrible", "buffer", ""}, {"arena", "perfect", "strict", ""},
                        {"conveyor", "4g", "strict", ""},       {"obstacle", "3g", "buffer", ""},
                        {"playground", "demo", "strict", ""},   {"derby", "4g", "buffer", "fade"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.scene) + " " + c.impair + " " + c.method);
    ClusterConfig config;
    config.scene = c.scene;
    config.impair = c.impair;
    config.mode = c.method;
    config.reconcile = c.reconcile;
    config.drive = Drive::kBot;
    config.duration_s = 10;
    const HonestOutcome outcome = RunHonest(config, false);
    EXPECT_GT(outcome.audited, 5);
    EXPECT_LT(outcome.audit, 0.9) << "of a lie";
    EXPECT_EQ(outcome.step, 0);
  }
}

/// Each was acted on before: by what the client's world had where the server's had nothing, by
/// differences after the client alone had heard nothing, and by a sum that had ceased to grow.
TEST(Audit, AnHonestClientOverABadNetworkLosesNothing) {
  struct Case {
    const char *scene, *impair;
    int seed, seconds;
    bool shown;
  };
  const Case cases[] = {
      {"crossing", "3g", 4, 30, false},
      {"crossing", "3g", 11, 30, false},
      {"crossing", "4g_driving", 6, 15, true},
      {"gas", "4g_driving", 1, 12, true},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.scene) + " " + c.impair + " " + std::to_string(c.seed));
    ClusterConfig config;
    config.scene = c.scene;
    config.impair = c.impair;
    config.mode = "buffer";
    config.seed = c.seed;
    config.drive = Drive::kBot;
    config.duration_s = c.seconds;
    const HonestOutcome outcome = RunHonest(config, c.shown);
    EXPECT_GT(outcome.judged, 100);
    EXPECT_LE(outcome.step, static_cast<int>(TrustStep::kWatched));
  }
}

TEST(Audit, ItTakesNoMoreThanItsBudget) {
  ClusterConfig config;
  config.scene = "pile";  // of 1000 bodies that one client holds
  config.mode = "strict";
  config.duration_s = 10;
  const HonestOutcome outcome = RunHonest(config, false);
  EXPECT_GT(outcome.steps, 1000);
  EXPECT_LE(outcome.steps, 11 * Auditor::kStepsPerS);
}

/// Honest clients take turns: their sleds are one body each, and shove crates.
TEST(Audit, ManyClientsTakeTurns) {
  ClusterConfig config = LargeRoom(1);
  config.drive = Drive::kBot;
  const HonestOutcome outcome = RunHonest(config, false);
  constexpr std::int64_t kTicks = 12 * 60, kBodies = 24;
  EXPECT_GT(outcome.audited, 100);
  EXPECT_LT(outcome.steps, 3 * kBodies * kTicks / 2);
  EXPECT_LT(outcome.audit, 0.5) << "of a lie: a turn that begins is no gain";
}

/// Listens, and sums up all that is published.
class SummingRecorder : public Recorder {
 public:
  void Publish(const std::string& channel, std::int64_t utime, ByteView bytes) override {
    audits_ += channel.find("audit") != std::string::npos ? 1 : 0;
    sum_ = Fnv1a(channel.data(), channel.size(), sum_);
    sum_ = Fnv1a(&utime, sizeof utime, sum_);
    sum_ = Fnv1a(bytes.data, bytes.size, sum_);
  }
  std::uint64_t sum() const { return sum_; }
  int audits() const { return audits_; }

 private:
  std::uint64_t sum_ = 1;
  int audits_ = 0;
};

TEST(Audit, TheSameSeedGivesTheSameBytes) {
  std::uint64_t sums[2] = {};
  for (std::uint64_t& sum : sums) {
    SummingRecorder recorder;
    ClusterConfig config = Uncopied("terrible", 3);
    config.recorder = &recorder;
    config.duration_s = 8;
    RunAttack(config, "gain0.5");
    EXPECT_GT(recorder.audits(), 3);
    sum = recorder.sum();
  }
  EXPECT_EQ(sums[0], sums[1]);
}

TEST(Audit, TheRoomIsTheSameToTheBitWithAndWithoutIt) {
  for (const char* scene : {"arena", "obstacle", "gluehouse"}) {
    for (const char* mode : {"buffer", "strict"}) {
      SCOPED_TRACE(std::string(scene) + " " + mode);
      ClusterConfig config;
      config.scene = scene;
      config.mode = mode;
      config.drive = Drive::kBot;
      config.duration_s = 5;
      config.keep = false;
      const auto look = [](const Server& server, TrustMode trust) {
        const Auditor* const auditor = ServerTestAccess::AuditorOf(server);
        EXPECT_EQ(auditor == nullptr, trust == TrustMode::kOff);
        if (auditor == nullptr) return;
        EXPECT_GT(auditor->counts().compared, 0);
      };
      const std::vector<std::uint64_t> hashes = HashesByTrust(config, look);
      EXPECT_EQ(hashes[0], hashes[1]);
      EXPECT_EQ(hashes[0], hashes[2]);
    }
  }
}

}  // namespace lab_audit_test
}  // namespace seam
