/// A client's releases, early, late or missing: it can give away its own mechanisms and affect no
/// others.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "client/embed/cluster.h"
#include "common/sync/lease.h"
#include "tests/support/authority_watch.h"
#include "tests/support/path/rewriting_net.h"
#include "tests/support/pendulums.h"
#include "tests/support/soak.h"

namespace seam {
namespace release_test {

constexpr int kAnn = 1, kBob = 2;

ClusterConfig Shuttle(const std::string& impair) {
  ClusterConfig config;
  config.scene = "pendulums.toml";
  config.scene_text = Pendulums(2);
  config.impair = impair;
  return config;
}

/// Ann's messages pass through `rewrite`.
void Tamper(ClusterConfig* config, RewritingNet::Rewrite rewrite,
            RewritingNet::RewriteHeader rewrite_header = {}) {
  config->client_net = [=](std::size_t client, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
    if (client != 0) return net;
    auto rewriting = std::make_unique<RewritingNet>(std::move(net), rewrite);
    rewriting->rewrite_header = rewrite_header;
    return rewriting;
  };
}

bool IsRelease(const Bytes& message) { return std::holds_alternative<Release>(Decode(message)); }

/// Counts the events in which a peer left for that reason.
int Said(const Recording& recording, const std::string& why) {
  int count = 0;
  for (const Event& event : recording.events) {
    count += event.text.find(why) != std::string::npos ? 1 : 0;
  }
  return count;
}

/// The longest time in the server's grants between a revocation and the next grant, us.
std::int64_t LongestHandOverUs(const Recording& recording) {
  const std::vector<double> ms = HandOverMs(recording);
  return ms.empty() ? 0 : static_cast<std::int64_t>(ms.back() * 1000);
}

TEST(Release, AHolderThatWithholdsItLosesTheMechanismAndItsPlace) {
  ClusterConfig config = Shuttle("demo");
  bool withheld = false;
  Tamper(&config, [&](std::int64_t, Bytes* message) {
    if (!IsRelease(*message)) return true;
    withheld = true;
    *message = Encode(Ping{});  // acknowledged like everything else, and no answer
    return true;
  });
  Cluster cluster(config);
  AuthorityWatch watch;
  cluster.each_instant = [&] { watch.Look(cluster); };
  cluster.Run();
  EXPECT_TRUE(withheld);
  EXPECT_GE(Said(cluster.recording(), "does not let go"), 1);
  EXPECT_EQ(watch.two_named_in_an_epoch, 0);
  EXPECT_EQ(watch.two_holders_of_an_epoch, 0);
  EXPECT_EQ(watch.several, 0) << "the one who is honest otherwise had let go";
  EXPECT_EQ(Said(cluster.recording(), "bob (peer 2) is gone"), 0);
}

TEST(Release, AHolderThatStopsAcknowledgingKeepsNothing) {
  ClusterConfig config = Shuttle("perfect");
  std::optional<std::pair<std::uint16_t, std::uint32_t>> frozen;
  std::int64_t from_us = 0;
  Tamper(
      &config,
      [](std::int64_t, Bytes* message) {
        if (IsRelease(*message)) *message = Encode(Ping{});
        return true;
      },
      [&](std::int64_t now_us, DatagramHeader* header) {
        if (from_us == 0) from_us = now_us + 4000000;
        if (now_us < from_us) return;
        if (!frozen) frozen = {header->ack, header->ack_bits};
        std::tie(header->ack, header->ack_bits) = *frozen;
      });
  Cluster cluster(config);
  std::map<int, std::int64_t> since;  // mechanism -> when ann was told to let go of it
  std::int64_t longest_us = 0;
  std::size_t read = 0;
  cluster.each_instant = [&] {
    const AuthorityTable& table = cluster.server().replica().authority();
    for (; read < cluster.recording().grants.size(); ++read) {
      const Grants& g = cluster.recording().grants[read];
      for (std::size_t i = 0; i < g.mechanism.size(); ++i) {
        if (g.authority[i] == 0) since.emplace(g.mechanism[i], cluster.now_us());
      }
    }
    for (int m = 0; m < table.count(); ++m) {
      const auto told = since.find(table.id(m));
      if (told == since.end()) continue;
      if (table.at(m).authority == kAnn) {
        longest_us = std::max(longest_us, cluster.now_us() - told->second);
      } else {
        since.erase(told);
      }
    }
  };
  cluster.RunToTick(60 * 16);
  EXPECT_LT(longest_us, kReleasePatienceUs + kEndingUs + 100000);
  EXPECT_GT(longest_us, kReleasePatienceUs - 100000) << "the test would show nothing";
}

bool HasGrants(const std::vector<Bytes>& messages) {
  return std::any_of(messages.begin(), messages.end(), [](const Bytes& message) {
    return std::holds_alternative<Grants>(Decode(message));
  });
}

/// Her pings are answered until long after the server's last revocation, which she never receives;
/// then she is cut off. Her lease ends when nobody has answered for 3 s, not before.
TEST(Release, AHolderThatNeverHearsTheRequestKeepsItUntilItsLeaseEnds) {
  ClusterConfig config = Shuttle("perfect");
  config.duration_s = 16;
  std::int64_t asked_us = -1;
  bool playing = false;
  int lost = 0;
  config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
    if (client != 0) return net;
    // False: it is lost.
    const auto look = [&](std::int64_t now_us, DatagramHeader*, std::vector<Bytes>* messages) {
      const bool grants = playing && HasGrants(*messages);
      if (asked_us < 0 && grants) asked_us = now_us;
      if (asked_us < 0) return true;
      lost += grants ? 1 : 0;
      return !grants && now_us <= asked_us + 3500000;
    };
    return std::make_unique<OpenedNet>(std::move(net), OpenedNet::Look(), look);
  };
  Cluster cluster(config);
  AuthorityWatch watch;
  cluster.each_instant = [&] {
    watch.Look(cluster);
    playing = cluster.server().started() && cluster.server().tick() > 60;
  };
  cluster.Run();
  EXPECT_GT(lost, 3);
  EXPECT_EQ(watch.several, 0);
  EXPECT_EQ(watch.two_holders_of_an_epoch, 0);
  EXPECT_GT(Said(cluster.recording(), "ann (peer 1) is gone"), 0);
}

TEST(Release, NoHonestHolderIsAccusedOnATerribleNetwork) {
  for (const int seed : SoakSeeds(1, 2)) {
    ClusterConfig config = Shuttle("terrible");
    config.scene_text = Pendulums(60);
    config.seed = seed;
    const Recording recording = RunCluster(config);
    EXPECT_EQ(Said(recording, "is gone"), 0) << "seed " << seed;
    EXPECT_GT(HandOverMs(recording).size(), 60u);
    EXPECT_LT(LongestHandOverUs(recording), kReleasePatienceUs * 3 / 4) << "seed " << seed;
  }
}

TEST(Release, LateReleasesDelayAHandOverAndNeverMakeTwoAuthorities) {
  for (const int seed : SoakSeeds(1, 3)) {
    ClusterConfig config = Shuttle("delay=50ms,jitter=10ms,loss=20%,reorder=5%:50ms");
    config.seed = seed;
    std::int64_t due_us = 0;
    const std::int64_t late_us = 400000 * seed;
    Tamper(&config, [&](std::int64_t now_us, Bytes* message) {
      if (!IsRelease(*message)) return true;
      if (now_us > due_us + 500000) due_us = now_us + late_us;  // another one
      return now_us >= due_us;
    });
    Cluster cluster(config);
    AuthorityWatch watch;
    cluster.each_instant = [&] { watch.Look(cluster); };
    cluster.Run();
    // A question that waits for longer is withdrawn, and asked again.
    EXPECT_GT(LongestHandOverUs(cluster.recording()), std::min(late_us, kWithdrawUs))
        << "seed " << seed;
    EXPECT_EQ(Said(cluster.recording(), "does not let go"), 0) << "seed " << seed;
    EXPECT_EQ(watch.several, 0) << "seed " << seed;
    EXPECT_EQ(watch.two_holders_of_an_epoch, 0) << "seed " << seed;
    EXPECT_EQ(watch.two_named_in_an_epoch, 0) << "seed " << seed;
  }
}

TEST(Release, WithholdingUnderLossAndReorderNeverMakesTwoAuthorities) {
  for (const int seed : SoakSeeds(1, 30)) {
    ClusterConfig config = Shuttle("delay=50ms,jitter=10ms,loss=20%,reorder=5%:50ms");
    config.seed = seed;
    int count = 0;
    Tamper(&config, [&](std::int64_t, Bytes* message) {
      if (IsRelease(*message) && ++count % 2 == 0) *message = Encode(Ping{});
      return true;
    });
    Cluster cluster(config);
    AuthorityWatch watch;
    cluster.each_instant = [&] { watch.Look(cluster); };
    cluster.Run();
    EXPECT_EQ(watch.several, 0) << "seed " << seed;
    EXPECT_EQ(watch.two_holders_of_an_epoch, 0) << "seed " << seed;
    EXPECT_EQ(watch.two_named_in_an_epoch, 0) << "seed " << seed;
  }
}

TEST(Release, AnEditDuringAHandOverLeavesNobodyWaiting) {
  ClusterConfig config = Shuttle("delay=100ms");
  config.scene_text = Pendulums(3);
  Cluster cluster(config);
  const auto revoking = [&] {
    const auto& grants = cluster.recording().grants;
    const AuthorityTable& table = cluster.server().replica().authority();
    if (grants.empty() || grants.back().authority.at(0) != 0) return false;
    // The first: the fate of all three follows from it.
    return grants.back().mechanism.at(0) == table.id(0) && table.at(0).authority != 0;
  };
  while (cluster.server().tick() < 60 * 10 && !revoking()) {
    cluster.RunToTick(cluster.server().tick() + 1);
  }
  ASSERT_TRUE(revoking());
  const PartId beam = 0;
  cluster.server().Order(Edit(FreeEdit{beam}, EditCause::kOutside));  // all become one mechanism
  cluster.RunToTick(cluster.server().tick() + 30);
  const AuthorityTable& table = cluster.server().replica().authority();
  ASSERT_EQ(table.count(), 1);
  cluster.RunToTick(cluster.server().tick() + 60 * 6);
  EXPECT_EQ(Said(cluster.recording(), "is gone"), 0);
  for (int c = 0; c < 2; ++c) {
    const AuthorityRecord& known = cluster.client(c)->replica()->authority().at(0);
    EXPECT_EQ(known.authority, table.at(0).authority) << "client " << c;
    EXPECT_EQ(known.epoch, table.at(0).epoch) << "client " << c;
  }
}

TEST(Release, ForgedReleasesAreCountedAndTakeNothingFromOthers) {
  ClusterConfig config = Shuttle("perfect");
  Cluster* room = nullptr;
  int forged = 0;
  Tamper(&config, [&](std::int64_t, Bytes* message) {
    const AnyMessage any = Decode(*message);
    if (room == nullptr || !std::holds_alternative<PackedStates>(any)) return true;
    const AuthorityTable& table = room->server().replica().authority();
    for (int m = 0; m < table.count(); ++m) {
      if (table.at(m).authority != kBob) continue;
      Release release;
      release.mechanism.push_back(table.id(m));
      release.epoch.push_back(table.at(m).epoch + 1);
      *message = Encode(release);
      ++forged;
      return true;
    }
    return true;
  });
  Cluster cluster(config);
  cluster.RunToTick(30);
  room = &cluster;
  const std::int64_t before = cluster.server().stats().dropped_right;
  const AuthorityTable& table = cluster.server().replica().authority();
  const AuthorityRecord then = table.at(0);
  cluster.RunToTick(40);
  EXPECT_GT(forged, 2);
  EXPECT_EQ(table.at(0).authority, then.authority);
  EXPECT_EQ(table.at(0).epoch, then.epoch) << "no hand-over of it began";
  EXPECT_GE(cluster.server().stats().dropped_right - before, forged - 2);
}

/// Two hundred discs change hands all the time: grants must not pile up behind lost ones.
TEST(ReleaseCluster, HoldersThatLetGoStayOverLossyLines) {
  for (const char* impair :
       {"delay=110ms,jitter=20ms,loss=30%", "delay=115ms,jitter=20ms,loss=21%"}) {
    SCOPED_TRACE(impair);
    ClusterConfig config;
    config.scene = "gas";
    config.impair = impair;
    config.drive = Drive::kBot;
    config.duration_s = 16;
    Cluster cluster(config);
    cluster.Run();
    EXPECT_EQ(Said(cluster.recording(), "is gone"), 0);
    EXPECT_GT(cluster.recording().grants.size(), 100U) << "hands must change";
  }
}

}  // namespace release_test
}  // namespace seam
