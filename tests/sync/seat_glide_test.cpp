/// A character on its way to a seat moves by centimetres a tick in every view.

#include "common/sync/show/seat_glide.h"

#include <gtest/gtest.h>

#include "common/sync/show/visual_offset.h"
#include "tests/support/small_world.h"

namespace seam {
namespace seat_glide_test {

const char* const kTwo =
    "[[part]]\nname = \"one\"\nbox = [1, 1]\nvelocity = [3, 0]\n"
    "[[part]]\nname = \"two\"\nbox = [1, 1]\nposition = [5, 0]\n";

std::vector<BodyState> PosesOf(const World& world) { return {world.Read(0), world.Read(1)}; }

TEST(SeatGlide, ABodyThatMovesAtItsVelocityIsNotLimited) {
  const std::unique_ptr<World> made = SmallWorld(kTwo, "", "gravity = [0, 0]");
  World& world = *made;
  const BodyTable bodies(world);
  SeatGlide glide(bodies);
  std::vector<BodyState> poses = PosesOf(world);
  EXPECT_FALSE(glide.HoldBack(world, {0, 1}, &poses)) << "nothing was shown before";
  glide.Shown(world, {0, 1}, poses);
  world.Step();
  poses = PosesOf(world);
  EXPECT_FALSE(glide.HoldBack(world, {0, 1}, &poses));
}

TEST(SeatGlide, AJumpIsLimitedToCentimetresByOneShareForAllBodies) {
  const std::unique_ptr<World> made = SmallWorld(kTwo, "", "gravity = [0, 0]");
  World& world = *made;
  const BodyTable bodies(world);
  SeatGlide glide(bodies);
  const std::vector<BodyState> before = PosesOf(world);
  glide.Shown(world, {0, 1}, before);
  world.Step();
  std::vector<BodyState> poses = before;
  poses[0].position.x() += 0.05f;  // 3 m/s
  poses[1].position.y() += 0.2f;
  poses[1].angle += 0.5f;
  ASSERT_TRUE(glide.HoldBack(world, {0, 1}, &poses));
  EXPECT_NEAR(poses[1].position.y(), 0.04, 1e-5);
  EXPECT_NEAR(poses[0].position.x(), 0.01, 1e-5);
  EXPECT_NEAR(poses[1].angle, 0.1, 1e-5);
  world.Step();
  EXPECT_FALSE(glide.HoldBack(world, {0, 1}, &poses)) << "what was not shown a tick ago is no way";
}

TEST(SeatGlide, ShiftTurnAndTheRestOfALimbTogetherStayWithinTheGentleLimit) {
  VisualOffset body, foot;
  body.position = {-0.4f, 0};
  foot.position = {-0.2f, 0.9f};
  foot.angle = body.angle = 1.2f;
  const Vec2 shown = foot.position;
  std::vector<OffsetBody> together(2);
  together[0].mass = {10, 1, Vec2(0, 0)};
  together[0].pose.position = {0, 1};
  together[0].offset = &body;
  together[1].mass = {1, 0.1f, Vec2(0, 0)};
  together[1].offset = &foot;
  ReturnTogether(1.0f / 60, 10, together, true);
  EXPECT_LT((foot.position - shown).norm(), 0.034f);
  EXPECT_GT((foot.position - shown).norm(), 0.01f);
}

}  // namespace seat_glide_test
}  // namespace seam
