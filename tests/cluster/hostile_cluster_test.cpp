/// Attacks on a room of real players by senders without a session or under another player's name.

#include <gtest/gtest.h>

#include "client/embed/cluster.h"
#include "common/net/datagram.h"
#include "common/net/link.h"
#include "common/net/loose_datagram.h"
#include "tests/cluster/rewritten_states.h"
#include "tests/support/live_session.h"
#include "tests/support/path/link_keys.h"
#include "tests/support/path/rewriting_net.h"
#include "tests/support/pendulums.h"
#include "tests/support/session_guest.h"

namespace seam {
namespace hostile_cluster_test {

ClusterConfig Crossing() {
  ClusterConfig config;
  config.impair = "perfect";
  config.drive = Drive::kBot;
  return config;
}

std::int64_t BytesWaiting(Net* net) {
  Address from;
  Bytes datagram;
  std::int64_t bytes = 0;
  while (net->Receive(&from, &datagram)) bytes += static_cast<std::int64_t>(datagram.size());
  return bytes;
}

TEST(Hostile, AThousandForgedHellosAllocateNothingAndAreNotAmplified) {
  Cluster cluster(Crossing());
  cluster.RunToTick(60);
  std::vector<std::unique_ptr<Net>> forged;
  std::int64_t in = 0;
  const auto send = [&](Net* net, ByteView datagram) {
    in += static_cast<std::int64_t>(datagram.size);
    net->Send(cluster.server_address(), datagram);
  };
  for (std::uint32_t n = 0; n < 1000; ++n) {
    forged.push_back(cluster.Attach(Address{0x0a000000 + n, 1000}));
    Hello hello;
    hello.name = "f" + std::to_string(n);
    if (n % 2 != 0) hello.protocol = 2;
    send(forged.back().get(), LooseDatagram(1 + n, Encode(hello), kHandshakeBytes));
    // Blind: goes on as if it had had an answer.
    DatagramWriter writer;
    send(forged.back().get(), writer.Finish({2, 1, 0}, Seal(LinkKeys(1 + n))));
  }
  int most = 0;
  cluster.each_instant = [&] { most = std::max(most, cluster.server().client_count()); };
  cluster.RunToTick(180);
  EXPECT_EQ(most, 2);
  std::int64_t out = 0;
  for (const auto& net : forged) out += BytesWaiting(net.get());
  EXPECT_GT(out, 0);
  EXPECT_LE(static_cast<double>(out), 0.33 * static_cast<double>(in));
  std::printf("[          ] %lld bytes in, %lld out, %d sessions at most\n",
              static_cast<long long>(in), static_cast<long long>(out), most);
}

TEST(Hostile, AHeaderWithAnotherSessionNumberDisconnectsNobody) {
  Cluster cluster(Crossing());
  cluster.RunToTick(60);
  cluster.Kill(1);
  cluster.RunToTick(60 + 40);
  const auto forger = cluster.Attach(Address{0x7f000001, 20001});
  DatagramWriter writer;
  forger->Send(cluster.server_address(), writer.Finish({1, 0, 0}, Seal(LinkKeys(12345))));
  cluster.RunToTick(60 + 60);
  EXPECT_EQ(cluster.server().client_count(), 2);
}

/// A guest of a cluster, at an address of its own.
Guest GuestOf(Cluster* cluster, const std::string& name) {
  Guest guest(cluster->Attach(Address{0x0a000001, 1000}), 4711, name);
  guest.server = cluster->server_address();
  return guest;
}

/// Runs for `ticks`; the guest sends Hello or Join until it is admitted, then its other messages.
void RunWith(Cluster* cluster, Guest* guest, std::int64_t ticks) {
  cluster->each_instant = [=] {
    guest->Read(cluster->now_us());
    if (guest->welcomed) {
      guest->Flush(cluster->now_us());
    } else if (guest->challenge) {
      guest->SayJoin();
    } else {
      guest->SayHello();
    }
  };
  cluster->RunToTick(cluster->server().tick() + ticks);
  cluster->each_instant = nullptr;
}

int HeldBy(Cluster& cluster, int peer) {
  const AuthorityTable& table = cluster.server().replica().authority();
  int held = 0;
  for (int m = 0; m < table.count(); ++m) held += table.at(m).authority == peer ? 1 : 0;
  return held;
}

TEST(Hostile, AStallOf1600MillisecondsDoesNotLoseTheCarToAnImpostor) {
  Cluster cluster(Crossing());
  cluster.RunToTick(60);
  const int held = HeldBy(cluster, 2);
  ASSERT_GT(held, 0);
  cluster.Pause(1, true);
  cluster.RunToTick(60 + 96);
  Guest thief = GuestOf(&cluster, "bob");
  RunWith(&cluster, &thief, 10);
  EXPECT_TRUE(thief.challenge.has_value());
  EXPECT_FALSE(thief.welcomed);
  EXPECT_EQ(thief.refusal, "the name bob is in use; no player is free");
  cluster.Pause(1, false);
  cluster.RunToTick(60 + 240);
  EXPECT_LT(FindEvent(cluster.recording(), "is gone"), 0);
  EXPECT_EQ(cluster.client(1)->rejoins(), 0);
  EXPECT_EQ(HeldBy(cluster, 2), held);
}

TEST(Hostile, APlayerAwayForTenSecondsRegainsItsReservedCarAtOnce) {
  Cluster cluster(Crossing());
  cluster.RunToTick(60);
  const int held = HeldBy(cluster, 2);
  cluster.Pause(1, true);
  cluster.RunToTick(60 + 540);
  EXPECT_EQ(cluster.server().client_count(), 1);
  EXPECT_EQ(HeldBy(cluster, 2), 0);
  Guest thief = GuestOf(&cluster, "bob");
  RunWith(&cluster, &thief, 60);
  EXPECT_FALSE(thief.welcomed) << "the name is held for 30 s";
  cluster.Pause(1, false);
  cluster.RunToTick(60 + 600 + 120);
  EXPECT_TRUE(cluster.client(1)->running());
  EXPECT_EQ(cluster.client(1)->peer(), 2);
  EXPECT_EQ(HeldBy(cluster, 2), held);
}

TEST(Hostile, AJointedBodyDoesNotFallFreelyEvenIfItsHolderSaysSo) {
  for (const bool lies : {false, true}) {
    ClusterConfig config;
    config.scene = "pendulums.toml";
    config.scene_text = Pendulums(4);
    config.impair = "perfect";
    config.duration_s = 4;
    int forged = 0;
    const Scene scene = ParseScene(config.scene_text, config.scene);
    std::vector<std::unique_ptr<RewrittenStates>> rewritten;  // by client
    config.client_net = [&](std::size_t, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
      rewritten.push_back(std::make_unique<RewrittenStates>(scene));
      RewrittenStates* const own = rewritten.back().get();
      return std::make_unique<RewritingNet>(std::move(net), [&, own](std::int64_t, Bytes* message) {
        if (!lies) return true;
        own->Rewrite(message, [&](States* states) {
          for (std::int8_t& flags : states->flags) {
            forged += (flags & kStateAsleep) == 0 ? 1 : 0;
            if ((flags & kStateAsleep) == 0) flags |= kStateFalls;
          }
        });
        return true;
      });
    };
    Cluster cluster(config);
    cluster.Run();
    int told = 0, falls = 0;
    for (const States& states : cluster.recording().states) {
      for (const std::int8_t flags : states.flags) {
        ++told;
        falls += (flags & kStateFalls) != 0 ? 1 : 0;
      }
    }
    EXPECT_GT(told, 50);
    EXPECT_EQ(forged > 50, lies);
    EXPECT_EQ(falls, 0) << "of " << told;
  }
}

TEST(Hostile, InputsBeforeReadyDoNotCount) {
  Cluster cluster(Crossing());
  cluster.RunToTick(60);
  cluster.Kill(1);
  cluster.Revive(1);  // its key is known from here on; the new client never ticks
  cluster.Pause(1, true);
  Guest bob = GuestOf(&cluster, "bob");
  bob.key = cluster.key(1);
  RunWith(&cluster, &bob, 10);
  ASSERT_TRUE(bob.welcomed);
  const auto press = [&] {
    Inputs inputs;
    inputs.player = 1;
    inputs.first_tick = cluster.server().tick() + 20;
    inputs.drive = inputs.lift = {99};
    inputs.buttons = {0};
    bob.link.SendUnreliable(Encode(inputs));
    RunWith(&cluster, &bob, 30);
  };
  const auto pressed = [&] {
    for (const auto& [tick, inputs] : cluster.recording().inputs.at(1)) {
      if (inputs.drive.back() == 99) return true;
    }
    return false;
  };
  const std::int64_t dropped = cluster.server().stats().dropped_right;
  press();
  EXPECT_FALSE(pressed());
  EXPECT_EQ(cluster.server().stats().dropped_right, dropped + 1);
  bob.link.SendReliable(Encode(Ready()));
  press();
  EXPECT_TRUE(pressed());
  EXPECT_EQ(cluster.server().stats().dropped_right, dropped + 1);
}

TEST(Hostile, AFlooderIsDecodedWithinItsBudgetAndRemoved) {
  Cluster cluster(Crossing());
  cluster.RunToTick(60);
  Guest flooder = GuestOf(&cluster, "flood");
  RunWith(&cluster, &flooder, 10);
  ASSERT_TRUE(flooder.welcomed);
  flooder.link.SendReliable(Encode(Ready()));
  RunWith(&cluster, &flooder, 10);
  const auto flood = [&](int datagrams) {
    const Bytes one(1, 0);
    for (int m = 0; m < datagrams * 392; ++m) {
      flooder.link.SendUnreliable(one);
      if (m % 392 == 391) flooder.Flush(cluster.now_us());
    }
  };
  const std::int64_t began = cluster.server().tick(), before = cluster.server().decoded();
  std::int64_t sent = 0, worst_late_us = 0;
  while (cluster.server().client_count() == 3 && cluster.server().tick() < began + 1200) {
    flood(20);
    sent += 20 * 392;
    flooder.Read(cluster.now_us());
    cluster.RunToTick(cluster.server().tick() + 1);
    worst_late_us = std::max<std::int64_t>(worst_late_us, cluster.server().stats().tick_late_us);
  }
  const double seconds = static_cast<double>(cluster.server().tick() - began) / 60;
  const double decoded = static_cast<double>(cluster.server().decoded() - before);
  // Its own messages, and those of the two players.
  const double allowed = AllowedTraffic(60, 30).messages, honest = HonestTraffic(60, 30).messages;
  EXPECT_LE(decoded, allowed * (seconds + kBudgetBurst) + 2 * honest * seconds);
  EXPECT_GT(static_cast<double>(sent), 10 * decoded);
  EXPECT_GT(cluster.server().stats().dropped_budget, 1000);
  EXPECT_GE(FindEvent(cluster.recording(), "is gone: sent more than it may for 10 s"), 0);
  EXPECT_EQ(cluster.server().client_count(), 2);
  EXPECT_LT(worst_late_us, 16667);
  std::printf("[          ] %lld messages sent in %.1f s, %.0f decoded, worst tick %lld us late\n",
              static_cast<long long>(sent), seconds, decoded,
              static_cast<long long>(worst_late_us));
}

TEST(Hostile, NoHonestClientLosesAnythingToItsBudgetOverAnyNetwork) {
  const auto expect_none = [](ClusterConfig config) {
    config.duration_s = 12;
    config.drive = Drive::kBot;
    Cluster cluster(config);
    cluster.Run();
    SCOPED_TRACE(config.scene + " " + config.mode + " over " + config.impair);
    const Stats& stats = cluster.server().stats();
    EXPECT_EQ(stats.dropped_budget, 0);
    // And the rate assumed for an honest client is not less than the rate sent here.
    const double sent = 12.0 * cluster.client_count();
    const TrafficRate need = HonestTraffic(cluster.scene().solver.tick_hz, config.send_hz);
    EXPECT_LT(static_cast<double>(stats.bytes_in) / sent, need.bytes);
    EXPECT_LT(static_cast<double>(cluster.server().decoded() + stats.datagrams_in) / sent,
              need.messages);
  };
  for (const ImpairProfile& profile : Profiles()) {
    for (const char* mode : {"buffer", "central"}) {
      ClusterConfig config;
      config.mode = mode;
      config.impair = profile.name;
      expect_none(config);
    }
  }
  for (const char* scene : {"gluehouse", "wall", "playground"}) {
    ClusterConfig config;
    config.scene = scene;
    config.send_hz = 60;
    expect_none(config);
  }
}

}  // namespace hostile_cluster_test
}  // namespace seam
