/// The send queue of one receiver: the most urgent body goes first, never beyond the budget, and
/// nothing is lost.

#include "server/interest/send_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "common/scene/scene.h"

namespace seam {
namespace send_queue_test {

constexpr int kBodies = 200;
constexpr std::int64_t kTickUs = 16667;

/// Size as a States message, which a budget counts at first.
std::size_t BytesOf(const SendQueue::Message& message) {
  return kStatesBytes.empty + kStatesBytes.each * message.size();
}

class SendQueueTest : public ::testing::Test {
 protected:
  SendQueueTest()
      : world_(ParseScene(R"(
gravity = [0, 0]
[[part]]
name = "disc"
circle = 0.1
position = [0, 0]
repeat = {count = [20, 10], step = [1, 1]}
)",
                          "discs")),
        newest_(world_, bodies_, 60) {
    States states;
    states.tick = 1;
    for (int id = 0; id < kBodies; ++id) {
      states.id.push_back(id);
      states.epoch.push_back(1);
      states.flags.push_back(0);
      for (auto* values :
           {&states.x, &states.y, &states.angle, &states.vx, &states.vy, &states.spin}) {
        values->push_back(static_cast<std::int16_t>(id));
      }
    }
    newest_.Take(states);
  }

  World world_;
  BodyTable bodies_{world_};
  NewestStates newest_;
};

TEST_F(SendQueueTest, WithoutABudgetEverythingGoesAtOnceInMessagesThatFit) {
  SendQueue send_queue(0);
  for (int id = 0; id < kBodies; ++id) send_queue.Add(0, id, Urgency::kFar);
  std::set<int> told;
  for (const SendQueue::Message& message : send_queue.Compose(0, newest_)) {
    EXPECT_LE(message.size(), kStatesBodiesMax);
    int before = -1;
    for (const WireBody* body = message.begin; body != message.end; ++body) {
      EXPECT_GT(body->id, std::exchange(before, body->id));
      EXPECT_EQ(static_cast<int>(body->x), body->id) << "it tells of that body";
      told.insert(body->id);
    }
  }
  EXPECT_EQ(told.size(), static_cast<std::size_t>(kBodies));
  EXPECT_TRUE(send_queue.empty());
}

TEST_F(SendQueueTest, KeepsTheBudgetSendsUrgentBodiesFirstAndAllEventually) {
  constexpr double kBudget = 8000;  // bytes/s: about 330 bodies
  SendQueue send_queue(kBudget);
  send_queue.Spend(2 * static_cast<std::size_t>(kBudget));  // the room was just sent
  for (int id = 0; id < kBodies; ++id) {
    send_queue.Add(0, id, id % 10 == 3 ? Urgency::kFollowed : Urgency::kFar);
  }
  std::vector<int> told;
  std::size_t bytes = 0;
  std::int64_t now_us = 0;
  for (; !send_queue.empty() && now_us < 10'000'000; now_us += kTickUs) {
    for (const SendQueue::Message& message : send_queue.Compose(now_us, newest_)) {
      const std::size_t size = BytesOf(message);
      send_queue.Spend(size);
      bytes += size;
      for (const WireBody* body = message.begin; body != message.end; ++body) {
        told.push_back(body->id);
      }
    }
    const auto followed =
        std::count_if(told.begin(), told.end(), [](int id) { return id % 10 == 3; });
    if (followed < kBodies / 10) {
      EXPECT_EQ(followed, static_cast<std::ptrdiff_t>(told.size())) << "they go first";
    }
    const double passed_s = 1e-6 * static_cast<double>(now_us) + 2 * SendCredit::kBurst;
    EXPECT_LE(static_cast<double>(bytes), kBudget * passed_s + kDatagramBytesMax);
  }
  EXPECT_TRUE(send_queue.empty()) << "what waits becomes urgent";
  ASSERT_EQ(told.size(), static_cast<std::size_t>(kBodies)) << "each once";
}

TEST_F(SendQueueTest, RaisingAPendingBodyRaisesThatBody) {
  SendQueue send_queue(2000);
  EXPECT_TRUE(send_queue.Compose(0, newest_).empty());
  send_queue.Spend(4000);  // the room
  for (int i = 0; i < kBodies; ++i) send_queue.Add(0, i * 77 % kBodies, Urgency::kFar);
  std::int64_t now_us = 0;
  for (; now_us < 100'000; now_us += kTickUs)
    EXPECT_TRUE(send_queue.Compose(now_us, newest_).empty());
  std::set<int> raised, told;
  for (int id = 7; id < kBodies; id += 20) raised.insert(id);
  for (const int id : raised) send_queue.Add(now_us, id, Urgency::kFollowed);
  for (; told.size() < raised.size() && now_us < 10'000'000; now_us += kTickUs) {
    for (const SendQueue::Message& message : send_queue.Compose(now_us, newest_)) {
      send_queue.Spend(BytesOf(message));
      for (const WireBody* body = message.begin; body != message.end; ++body) {
        told.insert(body->id);
      }
    }
  }
  for (const int id : raised) EXPECT_EQ(told.count(id), 1u) << id;
}

}  // namespace send_queue_test
}  // namespace seam
