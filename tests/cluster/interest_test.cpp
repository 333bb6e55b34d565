/// States that a client receives: all of followed bodies, of others only those it would reckon
/// wrongly, few of distant ones, hardly any outside its interest area; and inputs that move a body
/// that it simulates.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "common/codec/packed/states_unpacker.h"
#include "tests/support/path/opened_net.h"
#include "tests/support/soak.h"

namespace seam {
namespace interest_test {

/// Counts a client's received states by body, and inputs by player.
class CountingNet : public OpenedNet {
 public:
  struct Counts {
    std::map<int, int> states, inputs;
    std::size_t bytes = 0;
  };
  CountingNet(std::unique_ptr<Net> net, Counts* counts)
      : OpenedNet(std::move(net), {},
                  [this](std::int64_t, DatagramHeader*, std::vector<Bytes>* messages) {
                    for (const Bytes& message : *messages) Count(message);
                    return true;
                  }),
        counts_(counts) {}
  bool Receive(Address* from, Bytes* datagram) override {
    if (!OpenedNet::Receive(from, datagram)) return false;
    counts_->bytes += datagram->size();
    return true;
  }

 private:
  void Count(const Bytes& message) {
    const AnyMessage any = Decode(message);
    if (const auto* packed = std::get_if<PackedStates>(&any)) {
      const std::vector<States>* const all = unpacker_.Take(*packed);
      EXPECT_NE(all, nullptr);
      if (all == nullptr) return;
      for (const States& states : *all) {
        for (const std::int32_t id : states.id) ++counts_->states[id];
      }
    } else if (const auto* inputs = std::get_if<PackedInputs>(&any)) {
      const auto told = UnpackInputs(*inputs);
      EXPECT_TRUE(told.has_value());
      for (const Inputs& one : told.value_or(std::vector<Inputs>{})) {
        ++counts_->inputs[one.player];
      }
    }
  }

  Counts* counts_;
  StatesUnpacker unpacker_{PackedMotion(0, 0, 60)};
};

/// Ann is at the left; bob has discs that spin beside her, 25 m away and 300 m away, and drives one
/// at 25 m and the last. `follow`: largest number of bodies of a room that is followed whole;
/// `hear`: interest radius, m.
std::string Plain(int follow, int hear = 400) {
  return "gravity = [0, 0]\nduration = 8\nbuffer = 3\nserver_follow = 0\nfollow = " +
         std::to_string(follow) + "\n[planner]\nhear = " + std::to_string(hear) + R"(
[[player]]
name = "ann"
vehicle = "anns"
region = [[-100, -100], [-0.001, 100]]
[[player]]
name = "bob"
vehicle = "far"
region = [[0, -100], [900, 100]]
[[part]]
name = "anns"
circle = 0.4
position = [-1, 0]
spin = 5
[[part]]
name = "beside"
circle = 0.4
position = [1, 0]
spin = 5
[[part]]
name = "near"
circle = 0.4
position = [25, 0]
spin = 5
[[part]]
name = "far"
circle = 0.4
position = [300, 0]
spin = 5
[[part]]
name = "hub"
circle = 0.1
position = [300, 0]
anchored = true
[[joint]]
name = "axle"
kind = "hinge"
a = "hub"
b = "far"
motor = {player = "bob", speed = 5, torque = 1}
[[part]]
name = "driven"
circle = 0.4
position = [25, 5]
spin = 5
[[part]]
name = "hub2"
circle = 0.1
position = [25, 5]
anchored = true
[[joint]]
name = "axle2"
kind = "hinge"
a = "hub2"
b = "driven"
motor = {player = "bob", speed = 5, torque = 1}
)";
}

CountingNet::Counts CountAtAnn(int follow, double bytes_per_s = kClientBytesPerS, int hear = 400,
                               const char* reconcile = "") {
  CountingNet::Counts counts;
  ClusterConfig config;
  config.scene = "plain";
  config.scene_text = Plain(follow, hear);
  config.reconcile = reconcile;
  config.drive = Drive::kBot;
  config.impair = "delay=20ms";
  config.client_bytes_per_s = bytes_per_s;
  config.client_net = [&counts](std::size_t client, std::unique_ptr<Net> net) {
    return client == 0 ? std::make_unique<CountingNet>(std::move(net), &counts) : std::move(net);
  };
  Cluster cluster(config);
  cluster.RunToTick(60);
  counts = {};
  cluster.RunToTick(60 + 5 * 60);
  return counts;
}

constexpr int kBeside = 1, kNear = 2, kFar = 3, kDriven = 5, kBob = 1;

TEST(Interest, SendsFollowedBodiesFourTimesASecondAndOthersWhenTheReckoningErrs) {
  const CountingNet::Counts counts = CountAtAnn(1);
  // In five seconds, and one that was under way.
  EXPECT_NEAR(counts.states.at(kBeside), 5 * kRefreshHz, 2);
  EXPECT_NEAR(counts.states.at(kNear), 5 / kStateRepeatS, 3) << "it spins on as it did";
  EXPECT_GT(counts.states.at(kDriven), 20) << "a bot drives it";
  EXPECT_NEAR(counts.states.at(kFar), 5 / kFarReckoning.least, 4) << "and this one";
}

TEST(Interest, FollowedBodiesComeFirstWithinTheBudget) {
  constexpr int kBudget = 1000;
  // Under a rule whose followers get every send: a few states a second would not fill it.
  const CountingNet::Counts all = CountAtAnn(1, kClientBytesPerS, 400, "fade"),
                            few = CountAtAnn(1, kBudget, 400, "fade");
  EXPECT_LT(few.bytes, kBudget * 5 + 2 * kDatagramBytesMax) << "in five seconds, with a burst";
  EXPECT_GT(all.bytes, kBudget * 8u) << "without a budget it would be more";
  EXPECT_GT(few.states.at(kBeside), few.states.at(kDriven));
  EXPECT_GT(few.states.at(kNear), 0) << "nobody waits for ever";
  EXPECT_GT(few.states.at(kFar), 0);
}

TEST(Interest, InputsGoToPeersThatSimulateTheBodiesTheyMove) {
  EXPECT_EQ(CountAtAnn(1).inputs.count(kBob), 0u) << "his disc is 300 m away";
  EXPECT_GT(CountAtAnn(9).inputs[kBob], 50) << "a small room is followed whole";
}

TEST(Interest, ADistantBodyIsSentSeldom) {
  const CountingNet::Counts all = CountAtAnn(1), few = CountAtAnn(1, kClientBytesPerS, 60);
  const int told = few.states.count(kFar) > 0 ? few.states.at(kFar) : 0;
  EXPECT_LE(told, 5) << "once a second";
  EXPECT_LT(told, all.states.at(kFar));
  EXPECT_EQ(few.states.at(kBeside), all.states.at(kBeside));
  EXPECT_NEAR(few.states.at(kDriven), all.states.at(kDriven), 2) << "25 m away";
}

TEST(Interest, EachReceiverGetsWhatItDoesNotComeToByItself) {
  // In a small room: a player who simulates the body seldom, one under another rule with each send.
  // A player who predicts only what it drives and a spectator of mode central display it: it spins
  // on as it did, and is repeated.
  constexpr double kRepeatedPerS = 1 / kStateRepeatS;
  struct Case {
    const char *mode, *reconcile, *predict;
    std::size_t client;
    double sends_per_s;
  };
  for (const Case& of :
       {Case{"buffer", "rollback", "", 0, kRefreshHz}, Case{"buffer", "fade", "", 0, 30},
        Case{"central", "", "all", 0, kRefreshHz}, Case{"central", "", "own", 0, kRepeatedPerS},
        Case{"central", "", "all", 2, kRepeatedPerS}}) {
    SCOPED_TRACE(std::string(of.mode) + " " + of.reconcile + of.predict);
    CountingNet::Counts counts;
    ClusterConfig config;
    config.scene = "plain";
    config.scene_text = Plain(9);
    config.mode = of.mode;
    config.reconcile = of.reconcile;
    config.predict = of.predict;
    config.impair = "delay=20ms";
    config.spectators = 1;
    config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) {
      return client == of.client ? std::make_unique<CountingNet>(std::move(net), &counts)
                                 : std::move(net);
    };
    Cluster cluster(config);
    cluster.RunToTick(120);
    counts = {};
    cluster.RunToTick(120 + 4 * 60);
    EXPECT_NEAR(counts.states.at(kBeside), 4 * of.sends_per_s, 0.1 * 4 * of.sends_per_s + 1);
  }
}

/// A body's x in a client's view at a tick, m.
float Shown(const Recording& recording, int peer, std::int64_t tick, int id) {
  const auto& views = recording.views.at(peer);
  const auto view = views.find(tick);
  if (view == views.end()) return -1e6f;
  for (std::size_t i = 0; i < view->second.id.size(); ++i) {
    if (view->second.id[i] == id) return view->second.x[i];
  }
  return -1e6f;
}

TEST(Interest, ADistantBodyThatApproachesIsShownAtItsPlace) {
  constexpr int kComet = 7;
  ClusterConfig config;
  config.scene = "comet";
  config.scene_text = Plain(1, 60) + R"(
[[part]]
name = "comet"
circle = 0.4
position = [500, 10]
velocity = [-60, 0]
)";
  config.impair = "delay=20ms,loss=5%";
  Cluster cluster(config);
  cluster.RunToTick(8 * 60);
  const Recording& recording = cluster.recording();
  // After six seconds it is 140 m away and was told once a second, at 5 % loss; a second and a half
  // later it is 50 m away.
  const auto off = [&](std::int64_t tick) {
    const float x = 500 - static_cast<float>(tick);
    return std::fabs(Shown(recording, 1, tick, kComet) - x);
  };
  for (std::int64_t tick = 7 * 60 + 50; tick < 8 * 60; ++tick) {
    EXPECT_LT(off(tick), 0.5f) << "tick " << tick;
  }
}

/// Players 400 m apart, each with crates that fall on each other.
std::string Apart() {
  std::string text =
      "duration = 20\nfollow = 1\nserver_follow = 1\nbounds = [[-100, -50], [1500, 99]]";
  text += "\n[planner]\nhear = 60\n[[part]]\nname = \"ground\"\nchain = [[-50, 0], [1450, 0]]\n";
  for (int p = 0; p < 3; ++p) {
    const std::string name(1, static_cast<char>('a' + p)), x = std::to_string(400 * p);
    text += "[[player]]\nname = \"" + name + "\"\nvehicle = \"box-" + name + "\"\n";
    text += "[[part]]\nname = \"box-" + name + "\"\nbox = [1, 1]\nvelocity = [4, 0]\nposition = [" +
            x + ", 2]\n";
    text += "[[part]]\nname = \"crate-" + name + "\"\nbox = [1, 1]\nposition = [" + x +
            ".5, 4]\nrepeat = {count = 4, step = [0.1, 1.5]}\n";
  }
  return text;
}

TEST(Interest, DistantClientsKnowRestingBodiesExactly) {
  for (const int seed : SoakSeeds(1, 4)) {
    ClusterConfig config;
    config.scene = "apart";
    config.scene_text = Apart();
    config.drive = Drive::kNone;
    config.impair = "delay=50ms,jitter=10ms,loss=20%";
    config.seed = seed;
    Cluster cluster(config);
    cluster.RunToTick(8 * 60);
    const Replica& ours = cluster.server().replica();
    const auto agree = [&] {
      bool all = ours.rest().all();
      for (int c = 0; c < 3; ++c) {
        all = all && cluster.client(c)->replica()->rest().Hash() == ours.rest().Hash();
      }
      return all;
    };
    const auto epochs = [&] {
      std::vector<std::int32_t> all;
      for (int m = 0; m < ours.authority().count(); ++m) {
        all.push_back(ours.authority().at(m).epoch);
      }
      return all;
    };
    const std::vector<std::int32_t> before = epochs();
    // Everything has been still for four seconds: nobody has anything to send or to wake.
    int apart = 0;
    for (; cluster.server().tick() < 30 * 60; cluster.RunToTick(cluster.server().tick() + 6)) {
      apart += agree() ? 0 : 1;
    }
    EXPECT_EQ(apart, 0) << "seed " << seed;
    EXPECT_EQ(epochs(), before) << "seed " << seed << ": what sleeps went to and fro";
    for (int c = 0; c < 3; ++c) {
      const Replica& theirs = *cluster.client(c)->replica();
      EXPECT_EQ(theirs.world().composition().hash, ours.world().composition().hash);
      for (int body = 0; body < ours.world().body_count(); ++body) {
        EXPECT_EQ(theirs.world().Read(body).position, ours.world().Read(body).position)
            << "seed " << seed << ", client " << c << ", body " << body;
      }
    }
  }
}

}  // namespace interest_test
}  // namespace seam
