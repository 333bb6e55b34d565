/// rollback: exact to the wire's rounding if both worlds had the same contacts.

#include <gtest/gtest.h>

#include <algorithm>

#include "common/sync/quantize.h"
#include "tests/support/followed_copy.h"
#include "tests/support/quantised.h"

namespace seam {
namespace reconcile_rollback_test {

/// The copy is put wrong at tick 30; the largest distance from the truth from 30 ticks after the
/// first message about it until `ticks`, m.
float WorstAfter(FollowedCopy* f, const BodyState& by, int ticks) {
  f->Steps(30);
  const int last = f->truth.body_count() - 1;
  f->PutCopy(last, PlusScaled(f->copy.world().Read(last), by, 1));
  float worst = 0;
  for (int t = 31; t <= ticks; ++t) {
    f->Step();
    if (t < 60) continue;
    for (int body = 0; body < f->truth.body_count(); ++body) {
      worst = std::max(worst, f->Apart(body).norm());
    }
  }
  return worst;
}

BodyState By(float x, float vx) {
  BodyState by;
  by.position = Vec2(x, x / 2);
  by.velocity = Vec2(vx, -vx);
  by.angle = x;
  by.spin = vx;
  return by;
}

TEST(ReconcileRollback, IsExactToQuantisationInFreeFlight) {
  FollowedCopy f(
      "[[part]]\nname = \"a\"\nbox = [1, 0.5]\nposition = [0, 50]\n"
      "velocity = [6, 8]\nspin = 3\n",
      "rollback", 12);
  // A difference of four quanta is left alone; the velocity heard is wrong by half a quantum for
  // the 13 ticks after it.
  const float rounding = 4 * kPositionQuantum + 13 * kVelocityQuantum / 60 * 1.5f;
  EXPECT_LT(WorstAfter(&f, By(0.5f, 2), 150), rounding + 1e-4f);
}

TEST(ReconcileRollback, IsExactToQuantisationThroughABounce) {
  FollowedCopy f(
      "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n"
      "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 3]\nrestitution = 0.9\n",
      "rollback", 12);
  // It lands at tick 42 at 7 m/s. Rounding may move a bounce to the next tick: 2 v h / n of way.
  EXPECT_LT(WorstAfter(&f, By(0.2f, 0.5f), 240), 0.05f);
}

const char* kRampage =
    "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n"
    "[[part]]\nname = \"p1\"\nbox = [1, 1]\nposition = [0, 0.5]\n"
    "[[part]]\nname = \"p2\"\nbox = [1, 1]\nposition = [1.05, 0.5]\n"
    "[[part]]\nname = \"p3\"\nbox = [1, 1]\nposition = [0.5, 1.5]\n"
    "[[part]]\nname = \"ram\"\nbox = [1.5, 1]\nposition = [-9, 0.52]\nvelocity = [11, 0]\n"
    "friction = 0.1\n";

/// How far a separate world that begins with the wire's rounding of a tick's states diverges in
/// `ahead` ticks, for any tick from 30 on: a lower bound for every rule that knows only the states,
/// m.
float RoundingAlone(const char* scene, int ahead, int ticks) {
  World truth(ParseScene(scene, "s.toml"));
  std::vector<std::vector<BodyState>> path(1);
  for (int t = 1; t <= ticks; ++t) {
    truth.Step();
    path.emplace_back();
    for (int body = 0; body < truth.body_count(); ++body) path.back().push_back(truth.Read(body));
  }
  float worst = 0;
  for (int from = 30; from < ticks; from += 2) {
    World again(truth.scene());
    for (int body = 0; body < truth.body_count(); ++body) {
      const auto b = static_cast<std::size_t>(body);
      again.Write(body, Quantised(path[static_cast<std::size_t>(from)][b]));
    }
    for (int t = from + 1; t <= std::min(from + ahead, ticks); ++t) {
      again.Step();
      for (int body = 0; body < truth.body_count(); ++body) {
        const BodyState& was = path[static_cast<std::size_t>(t)][static_cast<std::size_t>(body)];
        worst = std::max(worst, (again.Read(body).position - was.position).norm());
      }
    }
  }
  return worst;
}

TEST(ReconcileRollback, IsAsExactAsRoundingLetsItBetweenAMovingBodyAndAPile) {
  // The ram, put wrong at tick 30, hits the pile at about tick 47: the copy goes back to before it.
  FollowedCopy f(kRampage, "rollback", 12), other(kRampage, "fade", 12);
  const float ours = WorstAfter(&f, By(0.1f, 0.5f), 150);
  const float rounding = RoundingAlone(kRampage, 14, 150);
  std::printf("[          ] off by %.4f m, rounding alone by %.4f m\n", ours, rounding);
  EXPECT_LT(ours, 2 * rounding + 0.01f);
  EXPECT_GT(WorstAfter(&other, By(0.1f, 0.5f), 150), 1.5f * ours);
}

TEST(ReconcileRollback, ReplaysOnceFromTheOldestOfManyMessages) {
  // Half a second of silence, then all at once.
  FollowedCopy f(kRampage, "rollback", 4);
  f.Steps(20);
  f.talking = false;
  f.PutCopy(3, PlusScaled(f.copy.world().Read(3), By(0.3f, 1), 1));
  f.Steps(30);
  EXPECT_GT(f.Apart(3).norm(), 0.1f);
  f.talking = true;
  f.Steps(2);
  EXPECT_LT(f.Apart(3).norm(), 0.02f);
}

TEST(ReconcileRollback, AStateOlderThanTheBarriersPlacesADistantCopy) {
  FollowedCopy f(
      "gravity = [0, 0]\n[solver]\nsleep = false\n"
      "[[part]]\nname = \"a\"\nbox = [1, 1]\nvelocity = [3, 0]\n",
      "rollback", 70);
  f.Steps(30);
  BodyState kicked = f.truth.Read(0);
  kicked.velocity = Vec2(0, 8);
  f.truth.Write(0, kicked);
  f.Steps(200);
  EXPECT_LT(f.Apart(0).norm(), 0.26f);
}

TEST(ReconcileRollback, OwnBodiesStayWhileOthersAreReplayed) {
  // Peer 1 holds the ram; its states of it stay valid through every replay.
  FollowedCopy f(kRampage, "rollback", 12, {3});
  f.Steps(30);
  f.PutCopy(0, PlusScaled(f.copy.world().Read(0), By(0.05f, 0.2f), 1));
  BodyState before = f.copy.world().Read(3);
  float worst = 0;
  for (int t = 0; t < 90; ++t) {
    f.Step();
    const BodyState after = f.copy.world().Read(3);
    worst = std::max(
        worst, (after.position - before.position - f.copy.world().dt() * after.velocity).norm());
    before = after;
  }
  EXPECT_LT(worst, 2e-2f) << "by its velocity and what pushes it out, never by a replay";
}

}  // namespace reconcile_rollback_test
}  // namespace seam
