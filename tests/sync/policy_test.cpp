/// Policies: the answers that tell the modes apart.

#include "common/sync/policy/policy.h"

#include <gtest/gtest.h>

#include "common/scene/scene.h"
#include "common/sync/edits/edit_order.h"
#include "common/sync/method.h"

namespace seam {
namespace policy_test {

Room RoomOf(const char* mode, const char* reconcile, const char* predict) {
  Room room;
  room.mode = mode;
  room.reconcile = reconcile;
  room.predict = predict;
  return room;
}

TEST(Policy, OnlyRollbackAndPredictingClientsGoBack) {
  for (const int self : {0, 1}) {
    EXPECT_FALSE(OraclePolicy().GoesBack(self));
    EXPECT_FALSE(StrictPolicy().GoesBack(self));
    EXPECT_FALSE(BufferPolicy(false).GoesBack(self));
    EXPECT_TRUE(BufferPolicy(true).GoesBack(self));
    EXPECT_EQ(CentralPolicy(true).GoesBack(self), self > 0);
    EXPECT_EQ(CentralPolicy(false).GoesBack(self), self > 0);
  }
  EXPECT_TRUE(CentralPolicy(true).TakesBarriers(0)) << "for its clients";
  EXPECT_FALSE(CentralPolicy(false).TakesBarriers(0));
}

TEST(Policy, ARecordingOfAnUnknownMethodHasOneAllTheSame) {
  EXPECT_EQ(&PolicyOf(RoomOf("buffer", "rollback", "")), &BufferPolicy(true));
  EXPECT_EQ(&PolicyOf(RoomOf("buffer", "resimulate", "")), &BufferPolicy(false));
  EXPECT_EQ(&PolicyOf(RoomOf("central", "", "")), &CentralPolicy(false));
  EXPECT_EQ(&PolicyOf(RoomOf("later", "", "")), &UnknownPolicy());
  EXPECT_FALSE(UnknownPolicy().PlansAuthority());
  EXPECT_FALSE(UnknownPolicy().TakesBarriers(0));
}

TEST(Policy, OnlyModesOfInputsAloneWaitForThem) {
  for (const char* mode : {"oracle", "central", "strict", "touch", "buffer"}) {
    const Policy& policy = PolicyOf(RoomOf(mode, "rollback", ""));
    EXPECT_EQ(policy.MostAhead(1), Policy::kAnyTicks) << mode;
    EXPECT_EQ(policy.InputDelay(4), 4);
    EXPECT_EQ(policy.InputDelay(0), 0);
    EXPECT_EQ(policy.SendsStates(), !policy.IsOracle());
  }
  for (const Policy* policy : {&LockstepPolicy(false), &LockstepPolicy(true), &GgpoPolicy()}) {
    EXPECT_EQ(policy, FindPolicy(policy->mode(), "", false));
    EXPECT_FALSE(policy->SendsStates());
    EXPECT_EQ(policy->MostAhead(0), 0) << "the server steps complete ticks";
    EXPECT_EQ(policy->InputDelay(5), 5);
    EXPECT_GT(policy->InputDelay(0), 0);
    EXPECT_FALSE(policy->GoesBack(0));
  }
  EXPECT_EQ(LockstepPolicy(false).MostAhead(1), 0);
  EXPECT_EQ(GgpoPolicy().MostAhead(1), 8);
  EXPECT_TRUE(GgpoPolicy().GoesBack(1));
}

TEST(Policy, OnlyTheOracleKnowsInputsByItself) {
  const Scene scene = ParseScene(
      "[[player]]\nname = \"ann\"\nvehicle = \"car\"\nscript = [[1.0, {drive = 0.5}]]\n"
      "[[part]]\nname = \"car\"\nbox = [1, 1]\nowner = \"ann\"\n",
      "s.toml");
  EXPECT_TRUE(BufferPolicy(true).KnownInputs(scene, 100, 0).empty());
  const std::vector<Inputs> early = OraclePolicy().KnownInputs(scene, 62, 3);
  const std::vector<Inputs> late = OraclePolicy().KnownInputs(scene, 63, 3);
  ASSERT_EQ(early.size(), 1u);
  ASSERT_EQ(late.size(), 1u);
  EXPECT_EQ(early[0].drive[0], 0);
  EXPECT_NE(late[0].drive[0], 0) << "the script's second, and three ticks of delay";
  EXPECT_EQ(late[0].first_tick, 63);
}

TEST(Policy, TheOraclesQueueTakesFoundEditsAtOnceAndOthersAtTheirTick) {
  const std::unique_ptr<EditQueue> queue = OraclePolicy().MakeEditQueue();
  EditOrder outside = ToOrder(Edit(PushEdit{1, {1, 0}, 0, 0}, EditCause::kOutside));
  outside.tick = 12;
  EXPECT_TRUE(queue->Take(outside, 7)) << "its number means nothing";
  EXPECT_TRUE(queue->Take(ToOrder(Edit(BreakEdit{0})), 7)) << "taken and ignored";
  queue->AfterStep(11);
  EXPECT_TRUE(queue->empty());
  EXPECT_TRUE(queue->TakeFound(Edit(BreakEdit{3}), 12));
  queue->AfterStep(12);
  EXPECT_EQ(queue->size(), 2u);
  EXPECT_NE(queue->Pop().edit.As<BreakEdit>(), nullptr) << "what physics found comes first";
  EXPECT_NE(queue->Pop().edit.As<PushEdit>(), nullptr);
}

TEST(Policy, OtherQueuesTakeOrdersByTheirNumber) {
  const std::unique_ptr<EditQueue> queue = BufferPolicy(true).MakeEditQueue();
  EXPECT_FALSE(queue->TakeFound(Edit(BreakEdit{3}), 12));
  EditOrder order = ToOrder(Edit(BreakEdit{0}));
  order.number = 5;
  EXPECT_FALSE(queue->Take(order, 4));
  EXPECT_TRUE(queue->Take(order, 5));
  EXPECT_FALSE(queue->Take(order, 5)) << "a repetition";
  order.number = 6;
  order.tick = -3;
  EXPECT_TRUE(queue->Take(order, 5));
  queue->Pop();
  EXPECT_EQ(queue->front().tick, 0) << "not before the order before it";
}

}  // namespace policy_test
}  // namespace seam
