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
  const Bytes expected = {0x00, 0x00, 0x80, 0x08, 0x10, 0x18, 0x20, 0x28, 0x30,
                          0x38, 0x40, 0x00, 0x00, 0x00, 0x1f, 0x46, 0x7c, 0x17,
                          0x80, 0x20, 0x08, 0x02, 0x00, 0x3f, 0xfc, 0x00, 0x00};
  EXPECT_EQ(packer.Take(0).front().packed.data, expected);
}

}  // namespace packed_reset_test
}  // namespace seam
