/// Compressed bytes come back bit for bit; hostile ones cost nothing and are refused.

#include "common/base/compress.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <string>

#include "common/base/random.h"
#include "tests/support/allocations/count_allocations.h"
#include "tests/support/soak.h"

namespace seam {
namespace compress_test {

constexpr std::size_t kMost = 100000;

Bytes Noise(std::size_t size, std::uint64_t seed = 1) {
  Random random(seed);
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.Next());
  return bytes;
}

TEST(Compress, GivesBackWhatItGot) {
  for (const std::size_t size : {1, 2, 100, 30000, 100000}) {
    for (const Bytes& content : {Noise(size), Bytes(size, '#')}) {
      const Bytes frame = Compress(content);
      EXPECT_LE(frame.size(), CompressedBytesMax(size));
      EXPECT_EQ(Decompress(frame, kMost), content) << size;
    }
  }
  EXPECT_LT(Compress(Bytes(kMost, '#')).size(), 100u);
}

TEST(Compress, RefusesAClaimAboveTheLimitBeforeItAllocates) {
  const Bytes bomb = Compress(Bytes(kMost + 1, '#'));
  ASSERT_LT(bomb.size(), 100u);
  const std::size_t before = AllocatedBytes();
  EXPECT_EQ(Decompress(bomb, kMost), std::nullopt);
  EXPECT_EQ(AllocatedBytes(), before);
  EXPECT_TRUE(Decompress(bomb, kMost + 1)) << "it is only too large";
  // A claim of 2^63 bytes: the header with an 8 byte size, by RFC 8878.
  Bytes huge = {0x28, 0xb5, 0x2f, 0xfd, 0xe0, 0, 0, 0, 0, 0, 0, 0, 0x80, 1, 0, 0};
  ASSERT_EQ(ZSTD_getFrameContentSize(huge.data(), huge.size()), 1ull << 63);
  EXPECT_EQ(Decompress(huge, kMost), std::nullopt);
  EXPECT_EQ(AllocatedBytes() - before, kMost + 1 + huge.size());
}

TEST(Compress, RefusesAContentThatIsLongerOrShorterThanItsClaim) {
  // A frame of less than 256 bytes says its size in one byte, behind magic and descriptor.
  Bytes frame = Compress(Bytes(200, '#'));
  constexpr std::size_t kSizeAt = 5;
  ASSERT_EQ(frame[kSizeAt], 200);
  for (const int claim : {1, 100, 199, 201, 255}) {
    frame[kSizeAt] = static_cast<std::uint8_t>(claim);
    EXPECT_EQ(Decompress(frame, kMost), std::nullopt) << claim;
  }
}

TEST(Compress, RefusesFramesThatDoNotSayTheirSize) {
  Bytes frame(1000);
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, 0);
  frame.resize(ZSTD_compress2(context, frame.data(), frame.size(), "abcabcabc", 9));
  ZSTD_freeCCtx(context);
  EXPECT_EQ(Decompress(frame, kMost), std::nullopt);
}

TEST(Compress, RefusesAllThatIsNotOneFrame) {
  const Bytes one = Compress(Bytes(500, 'a'));
  Bytes two = one;
  two.insert(two.end(), one.begin(), one.end());
  EXPECT_EQ(Decompress(two, kMost), std::nullopt) << "two frames";
  Bytes longer = one;
  longer.push_back(0);
  EXPECT_EQ(Decompress(longer, kMost), std::nullopt) << "a byte behind it";
  const Bytes skipped = {0x50, 0x2a, 0x4d, 0x18, 4, 0, 0, 0, 1, 2, 3, 4};
  EXPECT_EQ(Decompress(skipped, kMost), std::nullopt) << "a frame to be skipped";
  Bytes behind = skipped;
  behind.insert(behind.end(), one.begin(), one.end());
  EXPECT_EQ(Decompress(behind, kMost), std::nullopt) << "a frame behind one to be skipped";
  EXPECT_EQ(Decompress(Bytes(), kMost), std::nullopt);
  EXPECT_EQ(Decompress(Compress(Bytes()), kMost), std::nullopt) << "nothing";
  for (std::size_t size = 0; size < one.size(); ++size) {
    EXPECT_EQ(Decompress(ByteView(one.data(), size), kMost), std::nullopt) << "cut at " << size;
  }
}

TEST(Compress, DamageIsNoticedAndCostsNoMoreThanTheLimit) {
  std::string text;
  for (int i = 0; i < 400; ++i) text += "position = [" + std::to_string(i * i % 977) + ", 1]\n";
  const Bytes good = Compress(TextBytes(text));
  Random random(3);
  for (int round = 0; round < Soak(3000); ++round) {
    Bytes bad = good;
    for (int n = 1 + static_cast<int>(random.Next() % 4); n > 0; --n) {
      bad[random.Next() % bad.size()] ^= static_cast<std::uint8_t>(1 + random.Next() % 255);
    }
    if (bad == good) continue;
    const std::size_t before = AllocatedBytes();
    const std::optional<Bytes> read = Decompress(bad, kMost);
    EXPECT_LE(AllocatedBytes() - before, kMost);
    // Bits of the header that change nothing may be damaged; the content may not.
    if (read) {
      EXPECT_EQ(std::string(read->begin(), read->end()), text) << "round " << round;
    }
  }
  for (int round = 0; round < Soak(3000); ++round) {
    Bytes bad = Noise(random.Next() % 200, random.Next());
    const Bytes head(good.begin(), good.begin() + 9);
    bad.insert(bad.begin(), head.begin(), head.end());
    EXPECT_EQ(Decompress(bad, kMost), std::nullopt) << "round " << round;
  }
}

}  // namespace compress_test
}  // namespace seam
