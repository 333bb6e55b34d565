/// Packed states arrive bit for bit under loss, delay and reorder; and no bit pattern does harm.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <tuple>
#include <vector>

#include "common/codec/packed/states_packer.h"
#include "common/codec/packed/states_unpacker.h"
#include "common/codec/validate.h"
#include "tests/codec/balls.h"
#include "tests/support/soak.h"

namespace seam {
namespace packed_states_test {

const PackedMotion kMotion(0, -10, kBallsHz);

using Told = std::tuple<std::int32_t, std::int64_t, std::int32_t, std::int64_t, std::int32_t,
                        std::int32_t, int, int, int, int, int, int, int>;

/// All that States tell of bodies, in their order; places from the room's origin.
std::vector<Told> TellsOf(const std::vector<States>& all) {
  std::vector<Told> told;
  for (const States& s : all) {
    for (std::size_t i = 0; i < s.id.size(); ++i) {
      told.emplace_back(s.peer, s.tick, s.revision, s.composition, s.id[i], s.epoch[i], s.flags[i],
                        512 * s.origin_x + s.x[i], 512 * s.origin_y + s.y[i], s.angle[i], s.vx[i],
                        s.vy[i], s.spin[i]);
    }
  }
  return told;
}

struct Path {
  double loss = 0;          // of messages, and of acknowledgements
  std::size_t late = 0;     // messages that are under way, each way
  double out_of_order = 0;  // share of those that overtake others
  double width = 90;        // m that the balls are from the origin at most
  bool all = false;         // all of them are told in each tick
  std::size_t by = 1;       // how many they overtake
};

struct Traffic {
  std::size_t bytes = 0, bodies = 0, messages = 0;
};

/// Sends for `ticks`; expects the received states to equal the sent ones.
Traffic Send(std::uint64_t seed, const Path& path, int ticks) {
  Balls balls(seed, path.width);
  StatesPacker packer(kMotion);
  StatesUnpacker unpacker(kMotion);
  struct InFlight {
    std::vector<StatesPacker::Message> messages;
    std::vector<Told> told;
  };
  std::deque<InFlight> ways;
  std::deque<std::int64_t> acks;
  Traffic traffic;
  for (int tick = 0; tick < ticks; ++tick) {
    balls.Step();
    InFlight way;
    const std::vector<States> told = balls.Tell(path.all || tick % 5 == 0 ? 1 : 0.3);
    for (const States& states : told) packer.Add(states);
    way.told = TellsOf(told);
    way.messages = packer.Take(0);
    for (const auto& message : way.messages) {
      EXPECT_LE(message.packed.data.size(), kPackedBytesMax);
      traffic.bytes += message.packed.data.size();
      traffic.bodies += message.bodies;
      ++traffic.messages;
    }
    ways.push_back(way);
    if (ways.size() > path.by && balls.random().Chance(path.out_of_order)) {
      std::rotate(ways.end() - static_cast<std::ptrdiff_t>(path.by) - 1, ways.end() - 1,
                  ways.end());
    }
    if (ways.size() <= path.late) continue;
    std::vector<Told> arrived;
    bool whole = true;
    for (const auto& message : ways.front().messages) {
      if (balls.random().Chance(path.loss)) {
        whole = false;
        continue;
      }
      const std::vector<States>* const states = unpacker.Take(message.packed);
      EXPECT_NE(states, nullptr) << "message " << message.number;
      if (states == nullptr) return traffic;
      for (const Told& one : TellsOf(*states)) arrived.push_back(one);
      acks.push_back(message.number);
    }
    if (whole) {
      EXPECT_EQ(arrived, ways.front().told);
    }
    for (const Told& one : arrived) {
      const auto& all = ways.front().told;
      EXPECT_NE(std::find(all.begin(), all.end(), one), all.end());
    }
    ways.pop_front();
    for (; acks.size() > path.late; acks.pop_front()) {
      if (!balls.random().Chance(path.loss)) packer.Acknowledge(acks.front());
    }
  }
  return traffic;
}

TEST(PackedStates, ArriveAsTheyWereSentOverAnyNetwork) {
  for (const std::uint64_t seed : SoakSeeds(1, 4)) {
    SCOPED_TRACE(seed);
    Send(seed, Path{}, 200);
    Send(seed, Path{0.2, 6, 0.1}, 400);
    Send(seed, Path{0.5, 40, 0.5}, 400);  // acknowledged when the receiver has newer ones only
    Send(seed, Path{0.02, 300, 0.1}, 900);
    Send(seed, Path{1, 3, 0}, 100);
    Send(seed, Path{0.1, 5, 0.1, 400000}, 100);
    Path overtaken{0.1, 12, 0.3};
    overtaken.by = 8;
    Send(seed, overtaken, 400);
  }
}

TEST(PackedStates, TheReceiverForgetsBaselinesThatAreNoLongerUsed) {
  Balls balls(7, 20);
  StatesPacker packer(kMotion);
  StatesUnpacker unpacker(kMotion);
  std::deque<std::int64_t> acks;
  std::size_t bodies = 0;
  for (int tick = 0; tick < 2400; ++tick) {
    balls.Step();
    const bool all = tick % 40 == 0;  // most are told now and then
    for (const States& states : balls.Tell(all ? 1 : 0.02)) packer.Add(states);
    std::size_t told = 0;
    for (const auto& message : packer.Take(0)) {
      ASSERT_NE(unpacker.Take(message.packed), nullptr);
      told += message.bodies;
      acks.push_back(message.number);
    }
    if (all) bodies = std::max(bodies, told);
    for (; acks.size() > 4; acks.pop_front()) packer.Acknowledge(acks.front());
  }
  EXPECT_GT(bodies, 50u);
  EXPECT_GT(unpacker.kept(), bodies) << "what is older, for messages that were overtaken";
  EXPECT_LT(unpacker.kept(), 6 * bodies) << "of about 60 that were told of each";
}

TEST(PackedStates, AFlyingBodyTakesAThirdOfAPlainEntry) {
  const Traffic near = Send(1, Path{0, 6, 0, 20, true}, 600);
  EXPECT_LT(static_cast<double>(near.bytes), 21.0 / 3 * static_cast<double>(near.bodies));
  const Traffic never = Send(1, Path{1, 6, 0, 20, true}, 600);
  EXPECT_LT(static_cast<double>(never.bytes), 21.0 * static_cast<double>(never.bodies))
      << "nothing is acknowledged";
}

/// Feeds any bits; the result is valid.
void TakeAny(const Bytes& data, StatesUnpacker* unpacker) {
  PackedStates packed;
  packed.data = data;
  const std::vector<States>* const all = unpacker->Take(packed);
  if (all == nullptr) return;
  for (const States& states : *all) EXPECT_TRUE(Valid(states));
}

TEST(PackedStates, NoBitPatternDoesHarm) {
  Balls balls(3, 90);
  StatesPacker packer(kMotion);
  StatesUnpacker unpacker(kMotion), fooled(kMotion);
  for (int round = 0; round < Soak(60); ++round) {
    balls.Step();
    for (const States& states : balls.Tell(0.2)) packer.Add(states);
    for (const StatesPacker::Message& message : packer.Take(0)) {
      const Bytes good = message.packed.data;
      for (std::size_t size = 0; size < good.size(); ++size) {
        PackedStates cut;
        cut.data.assign(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_EQ(unpacker.Take(cut), nullptr) << size << " of " << good.size() << " bytes";
      }
      PackedStates longer{good};
      longer.data.push_back(0);
      EXPECT_EQ(unpacker.Take(longer), nullptr);
      EXPECT_NE(unpacker.Take(message.packed), nullptr) << "what was refused left nothing behind";
      for (int flip = 0; flip < 300; ++flip) {
        Bytes bytes = good;
        for (std::uint64_t n = 1 + balls.random().Next() % 3; n > 0; --n) {
          const std::uint64_t bit = balls.random().Next() % (8 * bytes.size());
          bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << bit % 8));
        }
        TakeAny(bytes, &fooled);
      }
      Bytes noise(balls.random().Next() % kPackedBytesMax);
      for (auto& byte : noise) {
        const std::uint64_t any = balls.random().Next();
        byte = static_cast<std::uint8_t>(round % 2 == 0 ? any : any % 8 == 0 ? 255 : 0);
      }
      TakeAny(noise, &fooled);
      packer.Acknowledge(message.number);
    }
  }
}

TEST(PackedStates, ALostStateIsRequestedUntilALaterOneArrives) {
  constexpr std::int64_t kLateUs = 100000;
  Balls balls(5, 20);
  StatesPacker packer(kMotion);
  const auto send = [&](std::int64_t now_us) {
    balls.Step();
    for (const States& states : balls.Tell(1)) packer.Add(states);
    return packer.Take(now_us);
  };
  const auto lost = [&](std::int64_t now_us) {
    return packer.TakeLost(now_us, kLateUs, [](std::int32_t) { return true; }).size();
  };
  for (const auto& message : send(0)) packer.Acknowledge(message.number);
  EXPECT_EQ(lost(kLateUs), 0u) << "it has arrived";
  const std::size_t bodies = [&] {
    std::size_t count = 0;
    for (const auto& message : send(1000000)) count += message.bodies;
    return count;
  }();
  EXPECT_EQ(lost(1000000 + kLateUs - 1), 0u) << "it may be under way";
  EXPECT_EQ(lost(1000000 + kLateUs), bodies);
  EXPECT_EQ(lost(1000000 + kLateUs + 99999), 0u);
  EXPECT_EQ(lost(1000000 + kLateUs + 100000), bodies) << "100 ms later again";
  EXPECT_EQ(lost(1000000 + kLateUs + 200000), 0u);
  EXPECT_EQ(lost(1000000 + kLateUs + 300000), bodies) << "and 200 ms after that";
  const auto repeat = send(1450000);
  for (const auto& message : repeat) packer.Acknowledge(message.number);
  EXPECT_EQ(lost(3000000), 0u) << "something newer has arrived";
  send(4000000);
  const auto nobody = [](std::int32_t) { return false; };
  EXPECT_EQ(packer.TakeLost(5000000, kLateUs, nobody).size(), 0u);
  EXPECT_EQ(lost(6000000), 0u) << "what nobody wants is forgotten";
}

TEST(PackedStates, RefusesDifferencesFromABaselineThatNeverCame) {
  Balls balls(5, 20);
  StatesPacker packer(kMotion);
  StatesUnpacker unpacker(kMotion);
  const auto message = [&] {
    balls.Step();
    for (const States& states : balls.Tell(1)) packer.Add(states);
    return packer.Take(0).front();
  };
  packer.Acknowledge(message().number);  // it says so, and it is not true
  EXPECT_EQ(unpacker.Take(message().packed), nullptr);
}

}  // namespace packed_states_test
}  // namespace seam
