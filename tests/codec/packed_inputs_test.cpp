/// Inputs of several players in one message: nothing is lost, and invalid messages are refused.

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "common/base/random.h"
#include "common/codec/codec.h"
#include "common/codec/validate.h"
#include "common/sync/inputs/input_source.h"
#include "tests/support/soak.h"

namespace seam {
namespace packed_inputs_test {

/// Inputs of a driving player: mostly held, or different in every tick; `ticks` of them up to
/// `last`.
Inputs Driven(int player, std::int64_t last, int ticks, bool held, Random* random) {
  Inputs inputs;
  inputs.player = player;
  inputs.first_tick = last + 1 - ticks;
  const auto any = [&](int least, int most) {
    return least + static_cast<int>(random->Next() % static_cast<unsigned>(most - least + 1));
  };
  for (int i = 0; i < ticks; ++i) {
    if (i > 0 && held) {
      inputs.drive.push_back(inputs.drive.back());
      inputs.lift.push_back(inputs.lift.back());
      inputs.buttons.push_back(inputs.buttons.back());
      continue;
    }
    inputs.drive.push_back(static_cast<std::int8_t>(any(-127, 127)));
    inputs.lift.push_back(static_cast<std::int8_t>(any(-127, 127)));
    inputs.buttons.push_back(static_cast<std::int16_t>(any(-32768, 32767)));
  }
  return inputs;
}

std::vector<PackedInputs> Pack(const std::vector<Inputs>& all) {
  InputsPacker packer;
  std::vector<PackedInputs> messages;
  for (const Inputs& inputs : all) {
    if (packer.Add(inputs)) continue;
    messages.push_back(packer.Finish());
    EXPECT_TRUE(packer.Add(inputs)) << "there is room for any in an empty one";
  }
  if (!packer.empty()) messages.push_back(packer.Finish());
  return messages;
}

void ExpectSame(const Inputs& got, const Inputs& sent) {
  EXPECT_EQ(got.player, sent.player);
  EXPECT_EQ(got.first_tick, sent.first_tick);
  EXPECT_EQ(got.drive, sent.drive);
  EXPECT_EQ(got.lift, sent.lift);
  EXPECT_EQ(got.buttons, sent.buttons);
}

TEST(PackedInputs, UnpackToAnyInputsThatWerePacked) {
  for (const std::uint64_t seed : SoakSeeds(1, 200)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Inputs> all;
    const std::int64_t now = static_cast<std::int64_t>(random.Next() % (1u << 30)) *
                             (seed % 5 == 0 ? 1023 : 1);
    const unsigned most = seed % 2 == 0 ? 64 : 16;
    for (int player = 0; player < kPlayersMax; player += 1 + static_cast<int>(random.Next() % 9)) {
      const int ticks = 1 + static_cast<int>(random.Next() % most);
      const auto late = static_cast<int>(random.Next() % (seed % 3 == 0 ? 2000 : 9));
      all.push_back(Driven(player, now + 2000 - late + ticks, ticks, random.Chance(0.5), &random));
    }
    std::vector<Inputs> got;
    for (const PackedInputs& message : Pack(all)) {
      EXPECT_TRUE(Valid(message)) << message.bits.size() << " bytes";
      const auto some = UnpackInputs(message);
      ASSERT_TRUE(some.has_value());
      for (const Inputs& inputs : *some) {
        EXPECT_TRUE(Valid(inputs));
        got.push_back(inputs);
      }
    }
    ASSERT_EQ(got.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) ExpectSame(got[i], all[i]);
  }
}

TEST(PackedInputs, HoldTheFirstAndTheLastPossibleTick) {
  Random random(1);
  for (const std::int64_t first : {std::int64_t{0}, kTickMax - 64}) {
    Inputs inputs = Driven(255, first + 63, 64, false, &random);
    inputs.first_tick = first;
    const auto got = UnpackInputs(Pack({inputs}).front());
    ASSERT_TRUE(got.has_value());
    ExpectSame(got->front(), inputs);
  }
}

TEST(PackedInputs, PlayersAscendInAMessage) {
  Random random(2);
  const std::vector<Inputs> all{Driven(5, 100, 3, true, &random), Driven(5, 101, 3, true, &random),
                                Driven(4, 101, 3, true, &random)};
  EXPECT_EQ(Pack(all).size(), 3u);
}

/// A player in a room of 64 bots receives the others' inputs; their newest acknowledged input is
/// `behind` ticks old.
TEST(PackedInputs, SixtyThreePlayersTakeATenthOfPlainInputs) {
  for (const int behind : {3, 8, 16}) {
    std::size_t plain = 0, packed = 0;
    for (std::int64_t tick = 100; tick < 700; ++tick) {
      std::vector<Inputs> all;
      for (int player = 0; player < 63; ++player) {
        Inputs inputs;
        inputs.player = player;
        inputs.first_tick = tick + 1 - behind;
        for (int i = 0; i < behind; ++i) {
          const Input input = BotInput(1, player, inputs.first_tick + i, 60);
          inputs.drive.push_back(input.drive);
          inputs.lift.push_back(input.lift);
          inputs.buttons.push_back(input.buttons);
        }
        plain += Encode(inputs).size();
        all.push_back(inputs);
      }
      for (const PackedInputs& message : Pack(all)) packed += Encode(message).size();
    }
    std::printf("[          ] %d ticks: %.1f bytes an input message, packed %.1f\n", behind,
                static_cast<double>(plain) / (600 * 63), static_cast<double>(packed) / (600 * 63));
    EXPECT_LT(packed, plain / 10);
  }
}

void TakeAny(const Bytes& data) {
  const auto all = UnpackInputs(PackedInputs{data});
  if (!all) return;
  int before = -1;
  for (const Inputs& inputs : *all) {
    EXPECT_TRUE(Valid(inputs));
    EXPECT_GT(inputs.player, before);
    EXPECT_LT(inputs.player, kPlayersMax);
    before = inputs.player;
  }
}

TEST(PackedInputs, NoBitPatternDoesHarm) {
  Random random(3);
  for (int round = 0; round < Soak(60); ++round) {
    std::vector<Inputs> all;
    for (int player = round % 7; player < 40; player += 1 + round % 4) {
      all.push_back(Driven(player, 1000, 1 + player, random.Chance(0.5), &random));
    }
    const Bytes good = Pack(all).front().bits;
    ASSERT_TRUE(UnpackInputs(PackedInputs{good}).has_value());
    for (std::size_t size = 0; size < good.size(); ++size) {
      const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_FALSE(UnpackInputs(PackedInputs{cut})) << size << " of " << good.size() << " bytes";
    }
    Bytes longer = good;
    longer.push_back(0);
    EXPECT_FALSE(UnpackInputs(PackedInputs{longer}));
    for (int flip = 0; flip < 300; ++flip) {
      Bytes bytes = good;
      for (std::uint64_t n = 1 + random.Next() % 3; n > 0; --n) {
        const std::uint64_t bit = random.Next() % (8 * bytes.size());
        bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << bit % 8));
      }
      TakeAny(bytes);
    }
    Bytes noise(random.Next() % kPackedBytesMax);
    for (auto& byte : noise) {
      const std::uint64_t any = random.Next();
      byte = static_cast<std::uint8_t>(round % 2 == 0 ? any : any % 8 == 0 ? 255 : 0);
    }
    TakeAny(noise);
  }
}

}  // namespace packed_inputs_test
}  // namespace seam
