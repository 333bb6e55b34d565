/// Rest is announced to relevant clients at once and to the others in turn; a lost announcement is
/// repeated block by block.

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "client/embed/cluster.h"
#include "tests/support/path/rewriting_net.h"

namespace seam {
namespace rest_interest_test {

constexpr int kCrates = 60;

/// Ann's wheel at the left; bob's 400 m away, and crates beside it that fall from ever higher, so
/// that each comes to rest for itself.
std::string Falling() {
  std::string text =
      "duration = 30\nfollow = 1\nserver_follow = 1\nbounds = [[-100, -50], [900, 400]]\n"
      "[planner]\nhear = 60\n[[part]]\nname = \"ground\"\nchain = [[-50, 0], [850, 0]]\n"
      "[[part]]\nname = \"crate\"\nbox = [1, 1]\nposition = [400, 0.5]\nowner = \"bob\"\nrepeat = "
      "{count = " +
      std::to_string(kCrates) + ", step = [1.2, 3]}\n";
  for (const auto& [name, x] : {std::pair("ann", "0"), std::pair("bob", "398")}) {
    const std::string who(name), at = "\nposition = [" + std::string(x) + ", 5]\n";
    text += "[[player]]\nname = \"" + who + "\"\nvehicle = \"wheel-" + who + "\"\n";
    text += "[[part]]\nname = \"hub-" + who + "\"\ncircle = 0.1" + at + "anchored = true\n";
    text += "[[part]]\nname = \"wheel-" + who + "\"\ncircle = 0.4" + at;
    text += "[[joint]]\nname = \"axle-" + who + "\"\nkind = \"hinge\"\na = \"hub-" + who +
            "\"\nb = \"wheel-" + who + "\"\nmotor = {player = \"" + who +
            "\", speed = 5, torque = 1}\n";
  }
  return text;
}

/// Called with a message that arrives at a client, or is sent by bob; may change it.
using Watch = std::function<void(Bytes* message)>;

ClusterConfig Room(std::map<std::size_t, Watch> received, Watch sent = {}) {
  ClusterConfig config;
  config.scene = "falling";
  config.scene_text = Falling();
  config.drive = Drive::kNone;
  config.impair = "delay=20ms";
  config.client_net = [=](std::size_t client, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
    auto watching = std::make_unique<RewritingNet>(std::move(net), [=](std::int64_t, Bytes* bytes) {
      if (client == 1 && sent) sent(bytes);
      return true;
    });
    if (received.count(client) > 0) {
      const Watch watch = received.at(client);
      watching->rewrite_received = [=](std::int64_t, Bytes* bytes) { watch(bytes); };
    }
    return watching;
  };
  return config;
}

const Rest* AsRest(const AnyMessage& any) { return std::get_if<Rest>(&any); }

std::uint64_t KnownBy(Cluster& cluster, int client) {
  return cluster.client(client)->replica()->rest().Hash();
}

TEST(RestInterest, RelevantClientsHearOfRestAtOnceAndTheOthersInTurn) {
  Cluster* room = nullptr;
  std::map<int, std::int64_t> at_ann, by_bob;  // by body: when it was first told, us
  int told_ann = 0, told_by_bob = 0;           // messages
  const auto count = [&room](std::map<int, std::int64_t>* at, int* told) {
    return [=, &room](Bytes* message) {
      const AnyMessage any = Decode(*message);
      const Rest* const rest = AsRest(any);
      if (rest == nullptr) return;
      ++*told;
      for (const std::int32_t id : rest->id) at->emplace(id, room->now_us());
    };
  };
  Cluster cluster(Room({{0, count(&at_ann, &told_ann)}}, count(&by_bob, &told_by_bob)));
  room = &cluster;
  cluster.RunToTick(20 * 60);
  ASSERT_GE(by_bob.size(), static_cast<std::size_t>(kCrates)) << "they have come to rest";
  EXPECT_GT(told_by_bob, 20) << "not all at once";
  EXPECT_LE(told_ann, told_by_bob / 3) << "once a second";
  std::int64_t latest_us = 0;
  for (const auto& [id, us] : by_bob) {
    ASSERT_EQ(at_ann.count(id), 1u) << id;
    latest_us = std::max(latest_us, at_ann.at(id) - us);
  }
  EXPECT_LT(latest_us, 1300000);
  EXPECT_GT(latest_us, 300000) << "she waits for her turn";
  const Replica& ours = cluster.server().replica();
  ASSERT_TRUE(ours.rest().all());
  EXPECT_EQ(KnownBy(cluster, 0), ours.rest().Hash());
  EXPECT_EQ(KnownBy(cluster, 1), ours.rest().Hash());
}

/// Both ways: of a message with rest that is lost for good (acknowledged, but without its content)
/// only the block is said again.
TEST(RestInterest, OnlyTheBlockWithALostRestIsRepeated) {
  for (const std::size_t loser : {0u, 1u}) {
    Cluster* room = nullptr;
    int lost = -1, again = 0, before = 0;
    std::int64_t lost_us = 0, again_us = 0;
    bool all_rests = false;
    const auto lose = [&](Bytes* message) {
      const AnyMessage any = Decode(*message);
      const Rest* const rest = AsRest(any);
      if (rest == nullptr) return;
      if (lost < 0 && ++before > 3) {
        lost = rest->id.front();
        lost_us = room->now_us();
        *message = Encode(Ready{});
        return;
      }
      for (const std::int32_t id : rest->id) {
        if (all_rests) ++again;
        if (id == lost && again_us == 0) again_us = room->now_us();
      }
    };
    // Ann loses a received announcement, or bob one of his own.
    Cluster cluster(loser == 0 ? Room({{0, lose}}) : Room({}, lose));
    room = &cluster;
    for (int second = 1; second <= 20; ++second) {
      cluster.RunToTick(second * 60);
      all_rests = cluster.client(1)->replica()->rest().all();
    }
    ASSERT_GE(lost, 0) << "loser " << loser;
    EXPECT_GT(again_us, 0) << "loser " << loser;
    EXPECT_LT(again_us - lost_us, 6000000) << "loser " << loser;
    EXPECT_LE(again, kCrates / 2) << "loser " << loser << ": a block, not the room";
    EXPECT_EQ(KnownBy(cluster, 0), cluster.server().replica().rest().Hash()) << "loser " << loser;
    EXPECT_EQ(KnownBy(cluster, 1), cluster.server().replica().rest().Hash()) << "loser " << loser;
  }
}

}  // namespace rest_interest_test
}  // namespace seam
