/// The server's key pairs for joins are gone when no join can need them.

#include "server/sessions/slot_keys.h"

#include <gtest/gtest.h>

namespace seam {
namespace slot_keys_test {

TEST(SlotKeys, LastForTheirSlotAndTheNextAndAreThenWiped) {
  SeededEntropy entropy(1);
  SlotKeys keys(entropy);
  const PublicKey first = keys.Draw(5).open;
  EXPECT_EQ(keys.Draw(5).open, first);
  const KeyPair* const kept = keys.Find(5);
  ASSERT_NE(kept, nullptr);
  keys.Forget(6);
  EXPECT_EQ(keys.Find(5), kept) << "joins of the slot before are good";
  keys.Forget(7);
  EXPECT_EQ(keys.Find(5), nullptr) << "also if nobody has said hello since";
  EXPECT_EQ(kept->secret, Secret()) << "zeros";
  EXPECT_NE(keys.Draw(7).open, first);
}

TEST(SlotKeys, TwoAreKeptWhileHellosCome) {
  SeededEntropy entropy(1);
  SlotKeys keys(entropy);
  for (std::int64_t slot = 1; slot < 6; ++slot) {
    const PublicKey open = keys.Draw(slot).open;
    EXPECT_EQ(keys.Find(slot)->open, open);
    EXPECT_EQ(keys.Find(slot - 1) != nullptr, slot > 1);
    EXPECT_EQ(keys.Find(slot - 2), nullptr);
  }
  EXPECT_EQ(keys.Find(-1), nullptr);
}

}  // namespace slot_keys_test
}  // namespace seam
