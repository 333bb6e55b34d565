/// The range coder: all that was written is read, in about as many bits as it is worth, and other
/// bytes are noticed.

#include "common/codec/packed/range_coder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/base/random.h"

namespace seam {
namespace range_coder_test {

/// Decisions of three kinds, raw bits and numbers, in a mixture that `random` chooses.
struct Piece {
  int kind = 0;  // 0..2: a decision, 3: raw, 4: a number, 5: a signed one
  std::uint64_t value = 0;
  int width = 0;
};

std::vector<Piece> Mixture(Random* random, int count) {
  std::vector<Piece> pieces;
  for (int i = 0; i < count; ++i) {
    Piece piece;
    piece.kind = static_cast<int>(random->Next() % 6);
    piece.width = static_cast<int>(random->Next() % (piece.kind == 3 ? 65 : 33));
    if (piece.kind < 3) piece.value = random->Chance(piece.kind == 0 ? 0.001 : 0.6) ? 1 : 0;
    if (piece.kind >= 3 && piece.width > 0) piece.value = random->Next() >> (64 - piece.width);
    if (random->Chance(0.1)) piece.value = piece.kind < 3 ? 1 : ~std::uint64_t{0};
    if (piece.kind == 3 && piece.width < 64) piece.value &= (std::uint64_t{1} << piece.width) - 1;
    pieces.push_back(piece);
  }
  return pieces;
}

Bytes Written(const std::vector<Piece>& pieces) {
  RangeWriter out;
  std::vector<BitModel> models(3);
  NumberModel number(0.1, 30), sized(0.9, 1);
  for (const Piece& p : pieces) {
    if (p.kind < 3) out.Put(p.value != 0, &models[static_cast<std::size_t>(p.kind)]);
    if (p.kind == 3) out.PutRaw(p.value, p.width);
    if (p.kind == 4) number.Put(static_cast<std::uint32_t>(p.value), &out);
    if (p.kind == 5) sized.PutSigned(static_cast<std::int32_t>(p.value), &out);
  }
  const std::size_t most = out.size();
  Bytes bytes = out.Finish();
  EXPECT_LE(bytes.size(), most);
  return bytes;
}

/// Returns true if the bytes are exactly these pieces.
bool Reads(const Bytes& bytes, const std::vector<Piece>& pieces) {
  RangeReader in{ByteView(bytes)};
  std::vector<BitModel> models(3);
  NumberModel number(0.1, 30), sized(0.9, 1);
  for (const Piece& p : pieces) {
    std::uint64_t got = 0;
    if (p.kind < 3) got = in.Get(&models[static_cast<std::size_t>(p.kind)]) ? 1 : 0;
    if (p.kind == 3) got = in.GetRaw(p.width);
    if (p.kind == 4) got = number.Get(&in);
    if (p.kind == 5) got = static_cast<std::uint32_t>(sized.GetSigned(&in));
    const std::uint64_t sent = p.kind < 4 ? p.value : static_cast<std::uint32_t>(p.value);
    if (got != sent) return false;
  }
  return in.AtEnd();
}

TEST(RangeCoder, ReadsWhatWasWritten) {
  Random random(1);
  for (int round = 0; round < 3000; ++round) {
    const std::vector<Piece> pieces = Mixture(&random, static_cast<int>(random.Next() % 40));
    EXPECT_TRUE(Reads(Written(pieces), pieces)) << round;
  }
}

TEST(RangeCoder, OtherBytesAreOtherPieces) {
  Random random(2);
  int changed = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<Piece> pieces = Mixture(&random, 10);
    pieces.push_back({1, 0, 0});  // as the end of a message: no more
    Bytes bytes = Written(pieces);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(size);
      EXPECT_FALSE(Reads(Bytes(bytes.begin(), end), pieces)) << round;
    }
    for (int i = 0; i < 5 && !bytes.empty(); ++i) {
      Bytes other = bytes;
      other[random.Next() % other.size()] ^= static_cast<std::uint8_t>(1 << random.Next() % 8);
      EXPECT_FALSE(Reads(other, pieces)) << round;
      ++changed;
    }
    bytes.push_back(static_cast<std::uint8_t>(random.Next()));
    EXPECT_FALSE(Reads(bytes, pieces)) << round;
  }
  EXPECT_GT(changed, 1000);
}

/// The entropy of decisions that come true in a hundredth of the cases is .081 bits each.
TEST(RangeCoder, DecisionsTakeAboutTheirEntropy) {
  for (const double share : {0.5, 0.1, 0.01}) {
    Random random(3);
    RangeWriter out;
    BitModel model;
    constexpr int kDecisions = 100000;
    for (int i = 0; i < kDecisions; ++i) out.Put(random.Chance(share), &model);
    const double bits = 8.0 * static_cast<double>(out.Finish().size()) / kDecisions;
    const double entropy = -share * std::log2(share) - (1 - share) * std::log2(1 - share);
    EXPECT_GT(bits, 0.99 * entropy) << share;
    EXPECT_LT(bits, 1.05 * entropy + 0.01) << share;
  }
}

/// 0xff bytes and a carry into them.
TEST(RangeCoder, CarriesReachTheFirstByte) {
  std::vector<Piece> pieces;
  for (int i = 0; i < 40; ++i) pieces.push_back({3, 0xffff, 16});
  for (int i = 0; i < 10; ++i) pieces.push_back({1, 0, 0});
  EXPECT_TRUE(Reads(Written(pieces), pieces));
}

}  // namespace range_coder_test
}  // namespace seam
