/// The keyed hash is SipHash-2-4, and the system's random numbers differ.

#include "common/net/keyed_hash.h"

#include <gtest/gtest.h>

#include "common/base/entropy.h"

namespace seam {
namespace keyed_hash_test {

TEST(KeyedHash, MatchesThePapersExample) {
  HashKey key;
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::uint8_t>(i);
  Bytes message;
  for (std::uint8_t i = 0; i < 15; ++i) message.push_back(i);
  EXPECT_EQ(KeyedHash(key, message), 0xa129ca6149be45e5u);
  key[0] = 1;
  EXPECT_NE(KeyedHash(key, message), 0xa129ca6149be45e5u);
}

TEST(Entropy, SystemEntropyDiffersAndSeededEntropyRepeats) {
  OsEntropy a, b;
  EXPECT_NE(a.Next(), b.Next());
  EXPECT_NE(a.Next(), a.Next());
  SeededEntropy c(5), d(5), e(6);
  for (int n = 0; n < 10; ++n) {
    const std::uint64_t number = c.Next();
    EXPECT_EQ(number, d.Next());
    EXPECT_NE(number, e.Next());
  }
}

}  // namespace keyed_hash_test
}  // namespace seam
