/// What a client hears of: everything of what it follows, of the rest what it would not guess, of
/// what is far not every detail; and of inputs those that move something that it simulates.

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/codec/packed/states_unpacker.h"
#include "common/net/datagram.h"
#include "tests/lab/cluster.h"

namespace seam {
namespace {

/// Counts what comes to a client: states by body, inputs by player.
class CountingNet : public Net {
 public:
  struct Counts {
    std::map<int, int> states, inputs;
    std::size_t bytes = 0;
  };
  CountingNet(std::unique_ptr<Net> net, Counts* counts) : net_(std::move(net)), counts_(counts) {}
  void Advance(std::int64_t now_us) override { net_->Advance(now_us); }
  void Flush() override { net_->Flush(); }
  std::int64_t discarded() const override { return net_->discarded(); }
  void Send(const Address& to, ByteView datagram) override { net_->Send(to, datagram); }
  bool Receive(Address* from, Bytes* datagram) override {
    if (!net_->Receive(from, datagram)) return false;
    counts_->bytes += datagram->size();
    std::vector<DatagramMessage> messages;
    if (!ReadMessages(*datagram, &messages)) return true;
    for (const DatagramMessage& message : messages) {
      const AnyMessage any = Decode(message.bytes);
      if (const auto* packed = std::get_if<PackedStates>(&any)) {
        const std::optional<std::vector<States>> all = unpacker_.Take(*packed);
        EXPECT_TRUE(all);
        for (const States& states : all.value_or(std::vector<States>{})) {
          for (const std::int32_t id : states.id) ++counts_->states[id];
        }
      } else if (const auto* inputs = std::get_if<Inputs>(&any)) {
        ++counts_->inputs[inputs->player];
      }
    }
    return true;
  }

 private:
  std::unique_ptr<Net> net_;
  Counts* counts_;
  StatesUnpacker unpacker_{PackedMotion(0, 0, 60)};
};

/// Ann at the left; bob has discs that spin beside her, 25 m away and 300 m away, and drives one
/// that is 25 m away and the last. `follow`: of how many bodies a room is one in which all is
/// followed.
std::string Plain(int follow) {
  return "gravity = [0, 0]\nduration = 8\nbuffer = 3\nserver_follow = 0\nfollow = " +
         std::to_string(follow) + R"(
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

CountingNet::Counts CountAtAnn(int follow, double bytes_per_s = kClientBytesPerS) {
  CountingNet::Counts counts;
  ClusterConfig config;
  config.scene = "plain";
  config.scene_text = Plain(follow);
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

TEST(Interest, WhatIsFollowedIsHeardOfAtOnceTheRestWhenItIsNotAsItWouldBeGuessed) {
  const CountingNet::Counts counts = CountAtAnn(1);
  // In five seconds at 30 sends a second, and a few that were under way.
  EXPECT_NEAR(counts.states.at(kBeside), 150, 8);
  EXPECT_NEAR(counts.states.at(kNear), 5 / kNewsRepeat, 3) << "it spins on as it did";
  EXPECT_GT(counts.states.at(kDriven), 20) << "a bot drives it";
  EXPECT_NEAR(counts.states.at(kFar), 5 / kFarNews.least, 4) << "and this one";
}

TEST(Interest, ABudgetIsKeptAndWhatIsFollowedComesFirst) {
  constexpr int kBudget = 1500;
  const CountingNet::Counts all = CountAtAnn(1), few = CountAtAnn(1, kBudget);
  EXPECT_LT(few.bytes, kBudget * 5 + 2 * kDatagramBytesMax) << "in five seconds, with a burst";
  EXPECT_GT(all.bytes, kBudget * 8u) << "without a budget it would be more";
  EXPECT_GT(few.states.at(kBeside), few.states.at(kDriven));
  EXPECT_GT(few.states.at(kNear), 0) << "nobody waits for ever";
  EXPECT_GT(few.states.at(kFar), 0);
}

TEST(Interest, InputsGoToWhoSimulatesWhatTheyMove) {
  EXPECT_EQ(CountAtAnn(1).inputs.count(kBob), 0u) << "his disc is 300 m away";
  EXPECT_GT(CountAtAnn(9).inputs[kBob], 50) << "a small room is followed whole";
}

}  // namespace
}  // namespace seam
