/// Touches that a replica tells: once each, however often a replay steps their ticks.

#include <gtest/gtest.h>

#include "tests/support/wired_replicas.h"

namespace seam {
namespace new_touches_test {

/// ann's sledge is pushed against a post at tick 31; without the push it never gets there. bob's
/// ball bounces in a box of its own.
const char* const kYard = R"(
gravity = [0, 0]
[[player]]
name = "ann"
vehicle = "sledge"
actions = [{button = 0, part = "sledge", impulse = [20, 0]}]
[[player]]
name = "bob"
[[part]]
name = "post"
box = [1, 4]
position = [4, 0]
anchored = true
restitution = 1
[[part]]
name = "left"
box = [1, 4]
position = [-20, 0]
anchored = true
restitution = 1
[[part]]
name = "right"
box = [1, 4]
position = [-15, 0]
anchored = true
restitution = 1
[[part]]
name = "sledge"
box = [1, 1]
position = [0, 0]
owner = "ann"
friction = 0
[[part]]
name = "ball"
circle = 0.5
position = [-17.5, 0]
velocity = [9, 0]
owner = "bob"
restitution = 1
friction = 0
)";

/// Touches that peer 0 tells in two seconds, while ann's inputs are known `late` ticks later.
std::vector<NewTouch> Told(std::int64_t late, std::int64_t* stepped_again) {
  WiredReplicas room(ParseScene(kYard, "yard.toml"), MakeSyncConfig("buffer", "rollback"), late,
                     [](int peer, std::int64_t tick) {
                       return Input{0, 0, static_cast<std::int16_t>(peer == 1 && tick > 30)};
                     });
  room.at(0).WatchTouches();
  std::vector<NewTouch> all;
  while (room.at(0).tick() < 120) {
    room.Step();
    for (const NewTouch& touch : room.at(0).TakeTouches()) all.push_back(touch);
  }
  *stepped_again = room.at(0).ticks_stepped_again();
  return all;
}

TEST(NewTouches, AReplayedTickNeitherDoublesNorLosesATouch) {
  std::int64_t again = 0;
  const std::vector<NewTouch> at_once = Told(0, &again);
  EXPECT_EQ(again, 0);
  std::size_t of_sledge = 0;
  for (const NewTouch& touch : at_once) of_sledge += touch.touch == PartTouch{0, 3} ? 1 : 0;
  EXPECT_EQ(of_sledge, 1u);
  EXPECT_GE(at_once.size(), 5u) << "the ball's, at 4 m a bounce";
  for (const std::int64_t late : {3, 9, 20}) {
    SCOPED_TRACE(late);
    const std::vector<NewTouch> told = Told(late, &again);
    EXPECT_GT(again, 0);
    ASSERT_EQ(told.size(), at_once.size());
    for (const NewTouch& touch : at_once) {
      const auto same = [&touch](const NewTouch& other) {
        return other.touch == touch.touch && other.tick == touch.tick;
      };
      EXPECT_EQ(std::count_if(told.begin(), told.end(), same), 1) << touch.tick;
    }
  }
}

}  // namespace new_touches_test
}  // namespace seam
