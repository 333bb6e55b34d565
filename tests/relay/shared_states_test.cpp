/// States packed once for many receivers.

#include "server/relay/shared_states.h"

#include <gtest/gtest.h>

#include "common/codec/codec.h"
#include "common/codec/packed/states_unpacker.h"

namespace seam {
namespace shared_states_test {

const PackedMotion kMotion(0, -10, 60);

/// The x of a body, 1/512 m: no two are alike, and none follows from the one before.
std::int64_t PlaceOf(std::int32_t id, std::int64_t tick) { return 7919 * id % 30000 + tick; }

States At(std::int64_t tick, const std::vector<std::int32_t>& ids) {
  States states;
  states.tick = tick;
  for (const std::int32_t id : ids) {
    states.id.push_back(id);
    states.epoch.push_back(1);
    states.x.push_back(static_cast<std::int16_t>(PlaceOf(id, tick)));
    states.y.push_back(7);
    states.angle.push_back(3);
    states.vx.push_back(60);
    states.vy.push_back(0);
    states.spin.push_back(0);
    states.flags.push_back(0);
  }
  return states;
}

/// A receiver that loses what the test wants.
struct Receiver {
  StatesUnpacker unpacker{kMotion};
  SentStates sent;
  std::map<std::int32_t, std::int64_t> newest;  // tick by body
  void Take(const SharedStates::Message& message, std::int64_t now_us, bool arrives = true) {
    sent.NoteSent(message.number, now_us);
    if (!arrives) return;
    sent.Acknowledge(message.number);
    const AnyMessage any = Decode(message.bytes);
    const auto* const all = unpacker.Take(std::get<PackedStates>(any));
    ASSERT_NE(all, nullptr);
    for (const States& states : *all) {
      for (std::size_t i = 0; i < states.id.size(); ++i) {
        std::int64_t& tick = newest[states.id[i]];
        tick = std::max(tick, states.tick);
        EXPECT_EQ(BodyAt(states, i).x,
                  static_cast<std::uint32_t>(PlaceOf(states.id[i], states.tick)));
      }
    }
  }
};

TEST(SharedStates, AMessageNeedsNoEarlierOne) {
  SharedStates shared(kMotion);
  Receiver late;
  for (std::int64_t tick = 2; tick <= 20; tick += 2) {
    shared.Add(At(tick, {1, 2, 5}));
    const auto messages = shared.Take(tick * 16667);
    ASSERT_EQ(messages.size(), 1u);
    if (tick >= 18) late.Take(messages[0], tick * 16667);
  }
  EXPECT_EQ(late.newest, (std::map<std::int32_t, std::int64_t>{{1, 20}, {2, 20}, {5, 20}}));
}

TEST(SharedStates, OnlyBodiesWithoutALaterStateAreToldAgain) {
  SharedStates shared(kMotion);
  Receiver one, other, third;
  shared.Add(At(2, {1, 2, 5}));
  for (const auto& message : shared.Take(0)) {
    one.Take(message, 0, false);
    third.Take(message, 0, false);
    other.Take(message, 0);
  }
  shared.Add(At(4, {2}));
  for (const auto& message : shared.Take(33333)) one.Take(message, 33333);
  EXPECT_TRUE(one.sent.TakeLost(100000, 150000, shared).empty()) << "too soon";
  const std::vector<std::int32_t> lost = one.sent.TakeLost(160000, 150000, shared);
  EXPECT_EQ(lost, (std::vector<std::int32_t>{1, 5}));
  EXPECT_TRUE(other.sent.TakeLost(160000, 150000, shared).empty());
  // That is lost as well, and told once more.
  for (const auto& message : shared.Again(160000, lost)) one.Take(message, 160000, false);
  EXPECT_EQ(third.sent.TakeLost(160000, 150000, shared), lost) << "the other one's loss too";
  const std::vector<std::int32_t> again = one.sent.TakeLost(320000, 150000, shared);
  EXPECT_EQ(again, lost);
  for (const auto& message : shared.Again(320000, again)) one.Take(message, 320000);
  EXPECT_TRUE(one.sent.TakeLost(900000, 150000, shared).empty());
  EXPECT_EQ(one.newest, (std::map<std::int32_t, std::int64_t>{{1, 2}, {2, 4}, {5, 2}}));
}

TEST(SharedStates, AMessageThatThePathDidNotCarryCountsAsLostAtOnce) {
  SharedStates shared(kMotion);
  SentStates sent;
  shared.Add(At(2, {3}));
  sent.NoteLeftOut(shared.Take(0).at(0).number);
  EXPECT_EQ(sent.TakeLost(1, 150000, shared), (std::vector<std::int32_t>{3}));
  EXPECT_TRUE(sent.TakeLost(1, 150000, shared).empty());
}

TEST(SharedStates, LongListsAreSplitAndEachPartIsFoundAgain) {
  constexpr std::int32_t kBodies = 900;
  SharedStates shared(kMotion);
  Receiver receiver;
  std::vector<std::int32_t> ids;
  for (std::int32_t id = 0; id < kBodies; ++id) ids.push_back(id);
  for (std::int32_t first = 0; first < kBodies; first += 30) {
    shared.Add(At(2, {ids.begin() + first, ids.begin() + first + 30}));
  }
  const auto messages = shared.Take(0);
  ASSERT_GT(messages.size(), 1u);
  for (std::size_t i = 0; i < messages.size(); ++i) receiver.Take(messages[i], 0, i != 1);
  const std::vector<std::int32_t> lost = receiver.sent.TakeLost(1000000, 150000, shared);
  EXPECT_EQ(lost.size() + receiver.newest.size(), static_cast<std::size_t>(kBodies));
  for (const auto& message : shared.Again(1000000, lost)) receiver.Take(message, 1000000);
  EXPECT_EQ(receiver.newest.size(), static_cast<std::size_t>(kBodies));
}

}  // namespace shared_states_test
}  // namespace seam
