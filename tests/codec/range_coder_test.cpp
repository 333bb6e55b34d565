/// The range coder: what is written is read, at nearly the entropy's cost.

#include "common/codec/packed/range_coder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/base/random.h"

namespace seam {
namespace range_coder_test {

/// Numbers of all widths, mostly small.
std::uint32_t Drawn(Random* random) {
  const auto value = static_cast<std::uint32_t>(random->Next());
  return random->Chance(0.5) ? 0 : value >> random->Next() % 32;
}

TEST(RangeCoder, ReadsWhatWasWritten) {
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    const double rare = 1.0 / static_cast<double>(1 + round);
    const std::size_t count = random.Next() % 200;
    std::vector<std::uint32_t> numbers;
    std::vector<bool> bits;
    RangeWriter writer;
    NumberModel number(50, 4);
    BitModel model;
    for (std::size_t i = 0; i < count; ++i) {
      numbers.push_back(Drawn(&random));
      bits.push_back(random.Chance(rare));
      writer.Code(numbers.back(), &number);
      writer.Code(bits.back(), &model);
      writer.Raw(numbers.back() * std::uint64_t{0x123456789}, 37);
    }
    const std::size_t bound = writer.size();
    const Bytes bytes = writer.Finish();
    EXPECT_LE(bytes.size(), bound);
    RangeReader reader(ByteView(bytes.data(), bytes.size()));
    NumberModel same(50, 4);
    BitModel like;
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(reader.Code(0, &same), numbers[i]);
      ASSERT_EQ(reader.Code(false, &like), bits[i]);
      ASSERT_EQ(reader.Raw(0, 37),
                numbers[i] * std::uint64_t{0x123456789} & ((std::uint64_t{1} << 37) - 1));
    }
    EXPECT_TRUE(reader.AtEnd());
    EXPECT_EQ(writer.Finish(), RangeWriter().Finish()) << "it begins anew";
  }
}

TEST(RangeCoder, CostsLittleMoreThanTheEntropy) {
  constexpr int kBits = 100000;
  for (const double rare : {0.5, 0.1, 0.01}) {
    Random random(2);
    RangeWriter writer;
    BitModel model;
    int ones = 0;
    for (int i = 0; i < kBits; ++i) ones += writer.Code(random.Chance(rare), &model) ? 1 : 0;
    const double p = static_cast<double>(ones) / kBits;
    const double entropy = -p * std::log2(p) - (1 - p) * std::log2(1 - p);
    const double cost = 8.0 * static_cast<double>(writer.Finish().size()) / kBits;
    EXPECT_GE(cost, 0.99 * entropy);
    EXPECT_LE(cost, 1.03 * entropy + 0.02) << rare;
  }
}

/// A run of bytes of 255 is changed by a carry.
TEST(RangeCoder, CarriesThroughBytesThatAreWritten) {
  int carried = 0;
  for (std::uint32_t last = 0; last < 2; ++last) {
    RangeWriter writer;
    for (int i = 0; i < 6; ++i) writer.Raw(0xffff, 16);
    BitModel sure(BitModel::kProbabilityLeast);
    for (int i = 0; i < 40; ++i) writer.Code(last == 1, &sure);
    const Bytes bytes = writer.Finish();
    RangeReader reader(ByteView(bytes.data(), bytes.size()));
    for (int i = 0; i < 6; ++i) ASSERT_EQ(reader.Raw(0, 16), 0xffffu);
    BitModel like(BitModel::kProbabilityLeast);
    for (int i = 0; i < 40; ++i) ASSERT_EQ(reader.Code(false, &like), last == 1);
    EXPECT_TRUE(reader.AtEnd());
    carried += bytes[0] == 0xff ? 1 : 0;
  }
  EXPECT_EQ(carried, 2);
}

TEST(RangeCoder, AnyBytesAreReadWithoutHarmAndEnd) {
  Random random(3);
  for (int round = 0; round < 1000; ++round) {
    Bytes bytes(1 + random.Next() % 40);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.Next());
    RangeReader reader(ByteView(bytes.data(), bytes.size()));
    NumberModel number(10, 4);
    int read = 0;
    while (reader.ok() && read < 100000) {
      reader.Code(0, &number);
      reader.Raw(0, 5);
      ++read;
    }
    EXPECT_LT(read, 100000);
  }
}

}  // namespace range_coder_test
}  // namespace seam
