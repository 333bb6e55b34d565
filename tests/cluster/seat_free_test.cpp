/// Seats of players that are gone, seats out of reach, and scripts that hear of both.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "client/embed/cluster.h"

namespace seam {
namespace seat_free_test {

/// ann gets into the cart at 1 s; bob asks for its seat at 3 s and at 45 s.
std::string Cart(const std::string& more = "") {
  return R"(duration = 60
gravity = [0, 0]
[[player]]
name = "ann"
vehicle = "hers"
region = [[-1000, -1000], [-0.001, 1000]]
script = [[0, {}], [1, {buttons = [5]}], [1.1, {}]]
[[player]]
name = "bob"
vehicle = "his"
region = [[0, -1000], [1000, 1000]]
script = [[0, {}], [3, {buttons = [5]}], [3.1, {}], [45, {buttons = [5]}], [45.1, {}]]
[[part]]
name = "cart"
box = [6, 2]
position = [-5, -1]
[[part]]
name = "hers"
box = [0.4, 0.4]
position = [-5, 1]
owner = "ann"
[[part]]
name = "his"
box = [0.4, 0.4]
position = [-4, 1.4]
owner = "bob"
[[seat]]
name = "saddle"
part = "cart"
at = [0, 1.6]
button = 5
[[thrust]]
name = "engine"
part = "cart"
force = [1, 0]
player = "saddle"
)" + more;
}

ClusterConfig Room(const std::string& scene) {
  ClusterConfig config;
  config.scene = "cart";
  config.scene_text = scene;
  config.impair = "demo";
  return config;
}

int InSeat(Cluster& cluster) { return cluster.server().replica().world().scene().seats[0].player; }

std::vector<std::string> Lines(Cluster& cluster, const std::string& with) {
  std::vector<std::string> lines;
  for (const Event& event : cluster.recording().events) {
    if (event.text.find(with) != std::string::npos) lines.push_back(event.text);
  }
  return lines;
}

TEST(SeatFree, TheSeatOfAKilledPlayerIsFreeWhenItsPlaceHasEnded) {
  for (const char* mode : {"buffer", "central"}) {
    SCOPED_TRACE(mode);
    ClusterConfig config = Room(Cart());
    config.mode = mode;
    Cluster cluster(config);
    cluster.RunToTick(6 * 60);
    EXPECT_EQ(InSeat(cluster), 0);
    EXPECT_EQ(Lines(cluster, "bob: ann sits in saddle").size(), 1u);
    cluster.Kill(0);
    cluster.RunToTick((6 + 28) * 60);
    EXPECT_EQ(InSeat(cluster), 0) << "her name is held for 30 s";
    cluster.RunToTick((6 + 32) * 60);
    EXPECT_EQ(InSeat(cluster), -1);
    EXPECT_EQ(Lines(cluster, "ann is gone: the seat saddle is free").size(), 1u);
    cluster.RunToTick(48 * 60);
    EXPECT_EQ(InSeat(cluster), 1);
  }
}

TEST(SeatFree, APlayerWhoComesBackInTimeStillSitsThere) {
  Cluster cluster(Room(Cart()));
  cluster.RunToTick(6 * 60);
  cluster.Kill(0);
  cluster.RunToTick(20 * 60);
  cluster.Revive(0);
  cluster.RunToTick(44 * 60);
  EXPECT_EQ(InSeat(cluster), 0);
}

TEST(SeatFree, AGoodbyeFreesItAtOnce) {
  Cluster cluster(Room(Cart()));
  cluster.RunToTick(6 * 60);
  cluster.Leave(0);
  cluster.RunToTick(8 * 60);
  EXPECT_EQ(InSeat(cluster), -1);
}

TEST(SeatFree, AScriptFreesItAndHearsOfSeats) {
  Cluster cluster(Room(Cart(R"([[script]]
name = "s"
code = '''
function on_seat(player, seat, news) world.say("news " .. player .. " " .. seat .. " " .. news) end
function on_leave(player)
  if world.seat(player) then world.unseat(player) end
end
'''
)")));
  cluster.RunToTick(5 * 60);
  cluster.Kill(0);
  cluster.RunToTick(14 * 60);
  EXPECT_EQ(InSeat(cluster), -1) << "on_leave comes after 4 s of silence";
  EXPECT_EQ(Lines(cluster, "news "),
            (std::vector<std::string>{"news ann saddle in", "news bob saddle taken",
                                      "news ann saddle out"}));
}

TEST(SeatFree, ASeatOutOfReachIsToldToTheRoomTheScriptAndThePlayerAlone) {
  std::string scene = Cart(
      "[[script]]\nname = \"s\"\ncode = \"function on_seat(p, s, n) "
      "world.say('news ' .. p .. ' ' .. s .. ' ' .. n) end\"\n");
  const std::string here = "position = [-4, 1.4]", there = "position = [3, 0.6]";
  scene.replace(scene.find(here), here.size(), there);
  scene.replace(scene.find("[1, {buttons"), 12, "[9, {buttons");
  scene.replace(scene.find("[1.1, {}"), 8, "[9.1, {}");
  Cluster cluster(Room(scene));
  cluster.RunToTick(5 * 60);
  const std::string text = "bob: no seat within reach; saddle is 8.0 m away, its reach is 2.0 m";
  EXPECT_EQ(Lines(cluster, "within reach"), std::vector<std::string>{text});
  EXPECT_EQ(Lines(cluster, "news "), std::vector<std::string>{"news bob saddle far"});
  EXPECT_EQ(cluster.client(1)->TakeNotice(), text);
  EXPECT_EQ(cluster.client(1)->TakeNotice(), "") << "once";
  EXPECT_EQ(cluster.client(0)->TakeNotice(), "");
}

}  // namespace seat_free_test
}  // namespace seam
