/// Sends a receiver only those states that its dead reckoning would miss.

#include "server/interest/newest_states.h"

#include <gtest/gtest.h>

#include "common/scene/scene.h"
#include "common/sync/quantize.h"

namespace seam {
namespace newest_states_test {

constexpr int kHz = 60;

class NewestStatesTest : public ::testing::Test {
 protected:
  NewestStatesTest()
      : world_(ParseScene("gravity = [0, 0]\n[[part]]\nname = \"disc\"\ncircle = 0.5\n"
                          "position = [0, 0]\n",
                          "disc")),
        newest_(world_, bodies_, kHz) {}

  /// The disc at x m after a tick, moving with vx m/s.
  News Tell(std::int64_t tick, double x, double vx, int epoch = 1,
            double repeat_s = kStateRepeatS) {
    States states;
    states.tick = tick;
    states.id = {0};
    states.epoch = {epoch};
    states.flags = {0};
    states.x = {static_cast<std::int16_t>(std::lround(512 * x))};
    states.vx = {static_cast<std::int16_t>(std::lround(256 * vx))};
    states.y = states.angle = states.vy = states.spin = {0};
    const NewestStates::Told& told = newest_.Take(states, repeat_s)[0];
    refresh_ = told.refresh;
    return told.news;
  }

  World world_;
  BodyTable bodies_{world_};
  NewestStates newest_;
  bool refresh_ = false;  // of the last Tell
};

TEST_F(NewestStatesTest, TheFirstStateGoesToAllAndAnExpectedOneToNobody) {
  EXPECT_FALSE(newest_.has(0));
  EXPECT_EQ(Tell(0, 0, 2), News::kAll);
  EXPECT_TRUE(newest_.has(0));
  for (int tick = 2; tick < 28; tick += 2) {
    EXPECT_EQ(Tell(tick, 2.0 * tick / kHz, 2), News::kNobody) << tick;
  }
  EXPECT_EQ(newest_.at(0).tick, 26);
}

TEST_F(NewestStatesTest, ATurnGoesToNearClientsAtOnceAndToFarOnesLater) {
  Tell(0, 0, 2);
  EXPECT_EQ(Tell(2, 0.07, 0), News::kNobody) << "3 mm off";
  EXPECT_EQ(Tell(6, 0.07, 0), News::kNear) << "13 cm off";
  EXPECT_EQ(Tell(8, 0.07, 0), News::kNobody) << "the near know that it stands";
  EXPECT_EQ(Tell(31, 0.07, 0), News::kAll) << "half a second has passed";
}

TEST_F(NewestStatesTest, RepeatsAStatePeriodicallyAndAfterAChangeOfHolder) {
  Tell(0, 0, 2);
  EXPECT_EQ(Tell(kHz / 2, 1, 2), News::kAll) << "one may be lost";
  EXPECT_EQ(Tell(kHz / 2 + 2, 1 + 2 * 2.0 / kHz, 2), News::kNobody);
  EXPECT_EQ(Tell(kHz / 2 + 4, 1 + 2 * 4.0 / kHz, 2, 2), News::kAll) << "another epoch";
}

TEST_F(NewestStatesTest, StatesForASilentHolderGoToAllTwiceAsOften) {
  Tell(0, 0, 2);
  const int quarter = kHz / 4;
  EXPECT_EQ(Tell(quarter - 1, 2.0 * (quarter - 1) / kHz, 2, 1, kStateRepeatSilentS), News::kNobody);
  EXPECT_EQ(Tell(quarter, 0.5, 2, 1, kStateRepeatSilentS), News::kAll);
  EXPECT_EQ(Tell(2 * quarter, 1, 2), News::kNobody) << "its holder is heard again";
}

/// A thrown ball is reckoned from the state of its release, so that its states are repeated twice a
/// second and sent where it bounces.
TEST(NewestStates, BouncesOfAFallingBodyAreRelevant) {
  World world(
      ParseScene("[[part]]\nname = \"ground\"\nbox = [40, 2]\nposition = [0, -1]\nanchored = "
                 "true\n[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 6]\n"
                 "velocity = [1, 2]\nrestitution = 0.8\n[solver]\nsubsteps = 2\n",
                 "ball"));
  const BodyTable bodies(world);
  NewestStates newest(world, bodies, kHz);
  int told = 0, bounces = 0, flights = 0;
  BodyState before = world.Read(0);
  for (int tick = 0; tick < 4 * kHz; ++tick) {
    world.Step();
    const BodyState now = world.Read(0);
    const bool falls = now.velocity.y() < before.velocity.y();
    bounces += falls ? 0 : 1;
    before = now;
    if (tick % 2 != 0) continue;
    ++flights;
    WireBody body = Quantise(now);
    body.id = 1;
    body.flags = falls ? kStateFalls : std::int8_t{0};
    const std::vector<States> states = Pack(
        [&] {
          States header;
          header.tick = world.tick();
          return header;
        }(),
        {body});
    told += newest.Take(states[0])[0].news == News::kNobody ? 0 : 1;
  }
  EXPECT_GE(bounces, 2);
  EXPECT_GE(flights, 100);
  // At a bounce the state of its tick, and the first of the flight after it.
  EXPECT_LE(told, 2 * 4 + 2 + 3 * bounces);
}

TEST_F(NewestStatesTest, ARefreshIsDueFourTimesASecondHoweverItMoves) {
  int refreshes = 0;
  for (int tick = 0; tick < 120; tick += 2) {
    Tell(tick, 0.01 * tick * (tick % 4), tick % 3);  // nothing like its dead reckoning
    refreshes += refresh_ ? 1 : 0;
  }
  EXPECT_EQ(refreshes, 8);
  Tell(120, 0, 0, 2);
  EXPECT_TRUE(refresh_) << "a new holder";
  Tell(122, 0, 0, 2);
  EXPECT_FALSE(refresh_);
}

TEST_F(NewestStatesTest, AStateThatComesSeldomIsPassedOnWhateverItsDistance) {
  int tick = 0;
  for (const int later : {15, 13, 17, 9, 8, 15, 14}) {
    Tell(tick += later, 0, 0);
    EXPECT_TRUE(refresh_) << later;
  }
}

}  // namespace newest_states_test
}  // namespace seam
