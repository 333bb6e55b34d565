/// A replica that corrects a copy, against the authority's world, message by message.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "common/base/geometry.h"
#include "common/sync/replica.h"

namespace seam {
namespace replica_correct_test {

const char* kBall =
    "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n"
    "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 3]\nrestitution = 0.9\n";

/// Peer 1 follows the authority's ball with `late` ticks of delay; just before the first bounce the
/// authority's is put `lower` m lower, so that it bounces a little earlier. The largest difference
/// of speed between the two but for two ticks after any bounce, m/s.
float WorstAfterBounces(float lower, std::int64_t late) {
  const Scene scene = ParseScene(kBall, "s.toml");
  World truth(scene);
  Replica copy(scene, MakeSyncConfig("buffer", "retrospect"), 1, -1);
  AuthorityRecord record;
  record.epoch = 1;
  record.secondaries.Add(1);
  copy.authority().Set(0, record);
  copy.RolesChanged();
  copy.StartAt(0);

  std::deque<States> wire;
  float worst = 0, before = 0, copy_before = 0;
  std::int64_t bounced = -10;
  for (std::int64_t tick = 1; tick <= 240; ++tick) {
    if (tick == 38) {  // it lands at 42
      BodyState moved = truth.Read(0);
      moved.position.y() -= lower;
      truth.Write(0, moved);
    }
    truth.Step();
    copy.Step();
    WireBody packed = Quantise(truth.Read(0));
    packed.id = truth.id(0);
    packed.epoch = 1;
    States header;
    header.tick = tick;
    header.composition = static_cast<std::int64_t>(truth.composition().hash);
    if (tick % 2 == 0) wire.push_back(Pack(header, {packed}).front());
    if (!wire.empty() && wire.front().tick + late <= tick) {
      copy.Receive(wire.front());
      wire.pop_front();
    }
    const float up = truth.Read(0).velocity.y(), copy_up = copy.world().Read(0).velocity.y();
    if ((before < -1 && up > 1) || (copy_before < -1 && copy_up > 1)) bounced = tick;
    before = up;
    copy_before = copy_up;
    if (tick - bounced > 2) worst = std::max(worst, std::fabs(up - copy_up));
  }
  return worst;
}

TEST(Correct, EqualWorldsStayEqual) { EXPECT_LT(WorstAfterBounces(0, 9), 0.05f); }

TEST(Correct, ABounceATickApartIsNotStruckTwice) {
  // 24 cm lower it arrives two ticks earlier at 7 m/s and 0.3 m/s slower. The message from between
  // the two bounces differs from our past by 13 m/s.
  EXPECT_LT(WorstAfterBounces(0.24f, 9), 1);
  EXPECT_LT(WorstAfterBounces(0.36f, 10), 1.5f);
}

/// A paddle of two blades whose root is one of them, 1.5 m from its centre of mass.
const char* kPaddle =
    "gravity = [0, 0]\n"
    "[[part]]\nname = \"end\"\nbox = [1, 0.2]\nposition = [0, 1]\n"
    "[[part]]\nname = \"blade\"\nbox = [1, 0.2]\nposition = [3, 1]\n"
    "[[joint]]\nname = \"fast\"\nkind = \"weld\"\na = \"end\"\nb = \"blade\"\n";

struct Shown {
  float turned = 0;  ///< by how much of a correction's 0.8 rad the view has turned at once
  float moved = 0;   ///< by how much its centre of mass has moved, m
};

/// A correction turns the paddle by 0.8 rad, moves its centre by (0.3, 0.1) m, and changes its spin
/// from `before` to `after` rad/s.
Shown CorrectPaddle(float before, float after) {
  const SyncConfig config = MakeSyncConfig("buffer", "rollback");
  World world(ParseScene(kPaddle, "s.toml"));
  const BodyTable bodies(world);
  const Roles roles(config, 1, -1, world, bodies);
  BodyMemory memory(config, world, bodies);
  Activities activities(config, world, roles, memory);
  Display display(config, world, memory, activities);
  const Vec2 centre = world.mass_point(0).centre;
  EXPECT_GT(centre.norm(), 1);
  const BodyState was = world.Read(0);
  BodyState is = was;
  is.angle += 0.8f;
  is.position += Vec2(0.3f, 0.1f) + Turned(centre, was.angle) - Turned(centre, is.angle);
  is.spin = after;
  world.Write(0, is);
  BodyState by = Minus(is, was);
  by.spin = after - before;
  display.Moved(0, by);
  const View view = display.MakeView(roles, true);
  const Vec2 shown = Vec2(view.x[0], view.y[0]) + Turned(centre, view.angle[0]);
  return {view.angle[0] - was.angle, (shown - was.position - Turned(centre, was.angle)).norm()};
}

TEST(Correct, ASpinningBodyTakesItsAngleAtOnceAndItsCentreGlides) {
  for (const auto& [before, after] : {std::pair{20.0f, 20.0f}, {20.0f, 0.0f}, {0.0f, -20.0f}}) {
    const Shown spinning = CorrectPaddle(before, after);
    EXPECT_NEAR(spinning.turned, 0.8f, 1e-5f) << before << " to " << after;
    EXPECT_NEAR(spinning.moved, 0, 1e-5f) << before << " to " << after;
  }
  const Shown slow = CorrectPaddle(2, -2);
  EXPECT_NEAR(slow.turned, 0, 1e-5f) << "what does not spin glides as a whole";
  EXPECT_NEAR(slow.moved, 0, 1e-5f);
}

}  // namespace replica_correct_test
}  // namespace seam
