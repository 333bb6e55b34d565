/// Packed states after a message that could not be read, in groups, and byte by byte.

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/codec/packed/states_packer.h"
#include "common/codec/packed/states_unpacker.h"
#include "tests/codec/balls.h"

namespace seam {
namespace packed_reset_test {

const PackedMotion kMotion(0, -10, kBallsHz);

/// Steps the balls and returns the messages that tell of all of them.
std::vector<StatesPacker::Message> TellAll(Balls* balls, StatesPacker* packer) {
  balls->Step();
  for (const States& states : balls->Tell(1)) packer->Add(states);
  return packer->Take(0);
}

TEST(PackedReset, AReceiverThatLostItsMemoryGoesOnOneRoundTripAfterItsReset) {
  for (const std::size_t late : {std::size_t{0}, std::size_t{1}, std::size_t{7}}) {
    Balls balls(11, 20);
    StatesPacker packer(kMotion);
    std::optional<StatesUnpacker> unpacker(kMotion);
    std::deque<StatesPacker::Message> way;
    struct Answer {
      std::int64_t acknowledged = -1;
      std::optional<Reset> reset;
    };
    std::deque<Answer> back;
    int refused = 0, since = 0;
    for (int tick = 0; tick < 200; ++tick) {
      if (tick == 60) unpacker.emplace(kMotion);
      for (auto& message : TellAll(&balls, &packer)) way.push_back(message);
      for (; way.size() > late; way.pop_front()) {
        // The datagram is acknowledged even if its message was refused.
        Answer answer{way.front().number, std::nullopt};
        if (unpacker->Take(way.front().packed) == nullptr) {
          answer.reset = StatesUnpacker::Refusal(way.front().packed);
          ++refused;
          since = tick;
        }
        back.push_back(answer);
      }
      for (; back.size() > late; back.pop_front()) {
        if (back.front().reset) {
          packer.Reset(static_cast<std::uint16_t>(back.front().reset->number));
        }
        packer.Acknowledge(back.front().acknowledged);
      }
    }
    EXPECT_GT(refused, 0) << late;
    EXPECT_LE(since, 60 + 2 * static_cast<int>(late) + 1) << "what was under way, no more";
  }
}

TEST(PackedReset, AResetMakesAllThatWasSentLost) {
  Balls balls(5, 20);
  StatesPacker packer(kMotion);
  const std::vector<StatesPacker::Message> sent = TellAll(&balls, &packer);
  for (const auto& message : sent) packer.Acknowledge(message.number);
  const auto lost = [&] {
    return packer.TakeLost(1000000, 100000, [](std::int32_t) { return true; }).size();
  };
  EXPECT_EQ(lost(), 0u);
  packer.Reset(static_cast<std::uint16_t>(sent.back().number + 1));
  EXPECT_EQ(lost(), 0u) << "that message was never sent";
  packer.Reset(static_cast<std::uint16_t>(sent.back().number));
  EXPECT_EQ(lost(), 60u);
}

TEST(PackedReset, ABodyThatTheRoomCannotHaveIsRefused) {
  Balls balls(5, 20);
  StatesPacker packer(kMotion);
  StatesUnpacker unpacker(kMotion);
  const PackedStates packed = TellAll(&balls, &packer).front().packed;  // ids 0, 7 ... 413
  EXPECT_EQ(unpacker.Take(packed, 413), nullptr);
  EXPECT_EQ(unpacker.kept(), 0u);
  EXPECT_NE(unpacker.Take(packed, 414), nullptr);
}

TEST(PackedReset, BodiesFarApartNeedNoMoreThanThoseTogether) {
  // States of one peer and tick begin anew where bodies are over 60 m apart; here each is alone.
  States together;
  std::vector<States> apart;
  for (int i = 0; i < 40; ++i) {
    States one;
    one.tick = together.tick = 100;
    for (States* to : {&one, &together}) {
      to->id.push_back(3 * i);
      to->epoch.push_back(1);
      to->flags.push_back(0);
      for (auto* all : {&to->x, &to->y, &to->angle, &to->vx, &to->vy, &to->spin}) {
        all->push_back(static_cast<std::int16_t>(10 * i));
      }
    }
    apart.push_back(one);
  }
  StatesPacker of_one(kMotion), of_many(kMotion);
  of_one.Add(together);
  for (const States& one : apart) of_many.Add(one);
  EXPECT_EQ(of_many.Take(0).front().packed.data, of_one.Take(0).front().packed.data);
}

/// A message names an earlier one that has come instead of revision, composition and tick.
TEST(PackedReset, AHeaderIsSaidOnceUntilAReset) {
  States states;
  states.revision = 7;
  states.composition = 0x0102030405060708;
  states.id = {5};
  states.epoch = {0};
  states.flags = {0};
  states.x = states.y = states.angle = states.vx = states.vy = states.spin = {0};
  StatesPacker packer(kMotion);
  StatesUnpacker unpacker(kMotion);
  const auto size_at = [&](std::int64_t tick, StatesUnpacker* receiver) {
    states.tick = tick;
    packer.Add(states);
    const StatesPacker::Message message = packer.Take(0).front();
    const std::vector<States>* const told = receiver->Take(message.packed);
    EXPECT_TRUE(told != nullptr && told->front().tick == tick &&
                told->front().revision == states.revision &&
                told->front().composition == states.composition)
        << tick;
    return std::make_pair(message.number, message.packed.data.size());
  };
  const auto [first, whole] = size_at(1000, &unpacker);
  packer.Acknowledge(first);
  const auto [second, named] = size_at(1002, &unpacker);
  EXPECT_LE(named + 10, whole);
  states.revision = 8;  // another: said whole
  EXPECT_GE(size_at(1004, &unpacker).second, named + 8);
  packer.Acknowledge(second);
  states.revision = 7;
  EXPECT_LE(size_at(1006, &unpacker).second, named + 1);
  packer.Reset(static_cast<std::uint16_t>(second));
  StatesUnpacker anew(kMotion);
  EXPECT_GE(size_at(1008, &anew).second + 2, whole);
}

TEST(PackedReset, TheExampleOfTheProtocolPageIsWritten) {
  States one;
  one.peer = 3;
  one.tick = 1000;
  one.composition = 0x0102030405060708;
  one.id = {5};
  one.epoch = {0};
  one.flags = {0};
  one.x = {512};
  one.y = {-512};
  one.angle = one.vx = one.vy = one.spin = {0};
  StatesPacker packer(kMotion);
  packer.Add(one);
  const Bytes expected = {0x00, 0x00, 0x00, 0x0f, 0x79, 0xe4, 0x4e, 0xb9, 0x23, 0x8d, 0xf7, 0xd8,
                          0x00, 0x00, 0x3c, 0x09, 0x64, 0x5e, 0x88, 0x56, 0x70, 0xa1, 0x3a};
  EXPECT_EQ(packer.Take(0).front().packed.data, expected);
}

}  // namespace packed_reset_test
}  // namespace seam
