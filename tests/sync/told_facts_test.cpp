/// States that a peer has sent for its own body stay valid when it learns that it was wrong about
/// others' bodies.

#include <gtest/gtest.h>

#include "tests/support/followed_copy.h"

namespace seam {
namespace told_facts_test {

/// A disc of one's own and one of somebody else's, both at rest, 20 m apart.
const char* const kTwoDiscs = R"(
gravity = [0, 0]
[[part]]
name = "own"
circle = 0.5
restitution = 1
[[part]]
name = "other"
circle = 0.5
position = [20, 0]
restitution = 1
)";

constexpr int kOwn = 0, kOther = 1;
constexpr std::int64_t kLate = 10;  // ticks

/// The other's disc strikes the own one only here: its authority has it 20 m away, and its state
/// arrives after the impact was sent. The first replay begins before the impact.
TEST(SentImpact, ABodySentAsStruckMovesOnAfterTheImpactIsUndone) {
  FollowedCopy peers(kTwoDiscs, "rollback", kLate, {kOwn});
  peers.Steps(90);
  ASSERT_FALSE(peers.copy_world().awake(kOwn)) << "what wakes it is the blow";
  peers.PutCopy(kOther, {{-3.5, 0}, 0, {30, 0}, 0});
  peers.Steps(9);
  const BodyState told = peers.copy_world().Read(kOwn);
  ASSERT_GT(told.velocity.x(), 25) << "struck";
  const std::int64_t before = peers.copy.ticks_stepped_again();
  peers.Steps(12);
  ASSERT_GT(peers.copy.ticks_stepped_again(), before) << "heard of it";
  ASSERT_LT(peers.Apart(kOther).norm(), 0.01);

  const BodyState now = peers.copy_world().Read(kOwn);
  EXPECT_TRUE(peers.copy_world().awake(kOwn));
  EXPECT_FLOAT_EQ(now.velocity.x(), told.velocity.x());
  EXPECT_NEAR(now.position.x(), told.position.x() + 12 * told.velocity.x() / 60, 1e-3);
}

}  // namespace told_facts_test
}  // namespace seam
