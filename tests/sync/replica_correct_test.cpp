/// A replica that corrects a copy, against the authority's world, message by message.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "common/sync/replica.h"

namespace seam {
namespace {

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
    PackedBody packed;
    packed.id = truth.id(0);
    packed.epoch = 1;
    packed.state = Quantised(truth.Read(0));
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

}  // namespace
}  // namespace seam
