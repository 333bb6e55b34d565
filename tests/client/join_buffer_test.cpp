/// Tests the states with which a late client begins: the last ones received, at their ticks.

#include "client/join_buffer.h"

#include <gtest/gtest.h>

#include "common/base/geometry.h"
#include "common/scene/scene.h"
#include "common/sync/quantize.h"

namespace seam {
namespace join_buffer_test {

Scene TwoBoxes() {
  return ParseScene(
      "[[part]]\nname = \"one\"\nbox = [1, 1]\nposition = [0, 3]\n"
      "[[part]]\nname = \"two\"\nbox = [1, 1]\nposition = [5, 3]\n",
      "two.toml");
}

class JoinBufferTest : public ::testing::Test {
 protected:
  JoinBufferTest() {
    config_.tick_hz = 60;
    replica_ = std::make_unique<Replica>(TwoBoxes(), config_, 1, -1);
  }
  std::int64_t composition() const {
    return static_cast<std::int64_t>(replica_->world().composition().hash);
  }
  /// It is at `x`, and moves at 2 m/s.
  void Moves(PartId id, std::int64_t tick, float x) {
    States header;
    header.tick = tick;
    header.composition = composition();
    PackedBody body;
    body.id = id;
    body.state = {{x, 3}, 0, {2, 0}, 0};
    for (const States& states : Pack(header, {body})) held_.Add(states);
  }
  void Lies(PartId id, std::int64_t tick, float x) {
    Rest rest;
    rest.tick = tick;
    rest.composition = composition();
    rest.id = {id};
    rest.epoch = {0};
    rest.x = {x};
    rest.y = {3};
    rest.angle = {0};
    held_.Add(rest);
  }
  BodyState Begun(PartId id) const {
    return replica_->world().Read(replica_->world().BodyOfId(id));
  }

  SyncConfig config_;
  std::unique_ptr<Replica> replica_;
  JoinBuffer held_;
};

TEST_F(JoinBufferTest, ABodyThatLeftRestMoves) {
  replica_->StartAt(70);
  Moves(0, 66, 1);
  Lies(0, 50, 0);
  held_.GiveTo(*replica_);
  EXPECT_NEAR(Begun(0).velocity.x(), 2, 0.01);
  EXPECT_NEAR(Begun(0).position.x(), 1 + 2 * 4 / 60.0, 0.01);
  EXPECT_FALSE(replica_->rest().Holds(replica_->world().BodyOfId(0)));
}

TEST_F(JoinBufferTest, ABodyThatCameToRestStaysAtRest) {
  replica_->StartAt(70);
  Lies(0, 66, 1);
  Moves(0, 50, 0);
  held_.GiveTo(*replica_);
  EXPECT_EQ(Begun(0).position.x(), 1);
  EXPECT_EQ(Begun(0).velocity.x(), 0);
  EXPECT_TRUE(replica_->rest().Holds(replica_->world().BodyOfId(0)));
}

TEST_F(JoinBufferTest, BeginsAtTheLatestTickThatIsKnownForEveryBody) {
  const World& world = replica_->world();
  EXPECT_EQ(held_.TickOf(world, 40, 70), 70) << "nothing was heard";
  Moves(0, 50, 0);
  Moves(0, 66, 0);
  Moves(1, 62, 0);
  EXPECT_EQ(held_.TickOf(world, 40, 70), 62);
  Moves(1, 69, 0);
  EXPECT_EQ(held_.TickOf(world, 40, 70), 66);
  EXPECT_EQ(held_.TickOf(world, 68, 70), 68) << "not earlier than that";
  EXPECT_EQ(held_.TickOf(world, 40, 64), 62) << "what is still to come does not count";
  Lies(0, 67, 0);
  EXPECT_EQ(held_.TickOf(world, 40, 70), 69) << "what lies is known of all ticks since";
}

TEST_F(JoinBufferTest, AStateOfALaterTickWaitsForItsTick) {
  Moves(0, 62, 0);
  Moves(1, 62, 5);
  Moves(1, 64, 7);
  replica_->StartAt(62);
  held_.GiveTo(*replica_);
  EXPECT_NEAR(Begun(0).position.x(), 0, 0.01);
  EXPECT_NEAR(Begun(1).position.x(), 5, 0.01);
  for (int i = 0; i < 4; ++i) replica_->Step();
  EXPECT_GT(Begun(1).position.x(), 6.9f) << "it was told of at tick 64";
}

TEST_F(JoinBufferTest, ABodyKnownOnlyFromALaterTickAppearsAtOnce) {
  Moves(0, 62, 0);
  Moves(1, 64, 7);
  replica_->StartAt(62);
  held_.GiveTo(*replica_);
  EXPECT_NEAR(Begun(1).position.x(), 7, 0.01);
}

TEST_F(JoinBufferTest, KeepsTheNewestStatesOfALongWait) {
  const auto ticks = static_cast<std::int64_t>(JoinBuffer::kHeldMax);
  Lies(1, 3, 5);
  for (std::int64_t tick = 1; tick <= 2 * ticks; ++tick) Moves(0, tick, 0.1f);
  Moves(0, 2 * ticks + 1, 7);
  EXPECT_LT(held_.size(), 600u) << "what was told since is let go";
  EXPECT_TRUE(held_.Covers(replica_->world(), 2 * ticks + 1));
  replica_->StartAt(2 * ticks + 1);
  held_.GiveTo(*replica_);
  EXPECT_NEAR(Begun(0).position.x(), 7, 0.01);
  EXPECT_EQ(Begun(1).position.x(), 5) << "what was said once of rest is not";
}

TEST_F(JoinBufferTest, NoServerCanFillTheMemoryOfAClient) {
  const auto most = static_cast<PartId>(JoinBuffer::kHeldMax);
  for (PartId id = 0; id < 2 * most; ++id) Moves(id, 5, 0);
  EXPECT_EQ(held_.size(), JoinBuffer::kHeldMax);
}

/// The wire's angles have lost their turns: nearest to where the scene had it, the second was six
/// radians beyond its hinge's limits, and the engine flung it.
TEST(JoinBufferMechanism, HasTheTurnsThatItsHingesAllow) {
  SyncConfig config;
  config.tick_hz = 60;
  Replica replica(ParseScene("gravity = [0, 0]\n[[part]]\nname = \"one\"\nbox = [1, 0.2]\n"
                             "[[part]]\nname = \"two\"\nbox = [1, 0.2]\nposition = [1, 0]\n"
                             "[[joint]]\nname = \"elbow\"\nkind = \"hinge\"\na = \"one\"\n"
                             "b = \"two\"\nanchor = [0.5, 0]\nlimits = [-1, 1]\n",
                             "elbow.toml"),
                  config, 1, -1);
  States header;
  header.tick = 70;
  header.composition = static_cast<std::int64_t>(replica.world().composition().hash);
  std::vector<PackedBody> bodies(2);
  bodies[1].id = 1;
  bodies[0].state.angle = 3;
  bodies[1].state.angle = 3.6f;
  const Vec2 elbow = Turned(Vec2(0.5f, 0), 3.0f);
  bodies[1].state.position = elbow + Turned(Vec2(0.5f, 0), 3.6f);
  JoinBuffer held;
  for (const States& states : Pack(header, bodies)) held.Add(states);
  replica.StartAt(70);
  held.GiveTo(replica);
  EXPECT_NEAR(replica.world().Read(1).angle - replica.world().Read(0).angle, 0.6, 1e-3);
  for (int tick = 0; tick < 5; ++tick) replica.Step();
  EXPECT_LT(replica.world().Read(1).velocity.norm(), 0.1f);
}

}  // namespace join_buffer_test
}  // namespace seam
