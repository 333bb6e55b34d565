/// Others are shown as they were, from a past that is known: a matter of display alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "client/embed/cluster.h"
#include "common/base/bytes.h"
#include "common/measure/measure.h"
#include "common/measure/revisions.h"
#include "common/sync/show/show_age.h"

namespace seam {
namespace show_age_cluster_test {

ClusterConfig With(const std::string& scene, const std::string& mode, int age_ticks) {
  ClusterConfig config;
  config.scene = scene;
  config.mode = mode;
  config.drive = Drive::kBot;
  config.show_age_ticks = age_ticks;
  config.duration_s = 6;
  return config;
}

/// A hash of all messages of the bus but views and their like, and of what was sent.
class Physics : public Recorder {
 public:
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override {
    // Checksums cover the views.
    for (const char* kind : {".view.", ".chain."}) {
      if (channel.find(kind) != std::string::npos) return;
    }
    value_ = Fnv1a(channel.data(), channel.size(), value_);
    value_ = Fnv1a(&utime, sizeof utime, value_);
    value_ = Fnv1a(message.data, message.size, value_);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = Fnv1a("", 0);
};

struct Played {
  Recording recording;
  std::uint64_t physics = 0, world = 0;
};

Played RunWith(ClusterConfig config) {
  Physics physics;
  config.recorder = &physics;
  Cluster cluster(config);
  cluster.Run();
  Played run;
  run.recording = cluster.recording();
  run.physics = physics.value();
  run.world = cluster.server().replica().world().Hash();
  return run;
}

Measures MeasuresOf(const Recording& recording) {
  return Measure(recording, ComputeOracle(recording, JudgeOf(recording.room)));
}

TEST(ShowAge, ChangesNoPhysicsAndNoMessageOfIt) {
  for (const char* mode : {"buffer", "central", "strict"}) {
    for (const auto& [scene, impair] : {std::pair{"crossing", "demo"}, std::pair{"scrum", "4g"}}) {
      SCOPED_TRACE(std::string(scene) + ", " + mode);
      ClusterConfig present = With(scene, mode, 0), past = With(scene, mode, 8);
      present.impair = past.impair = impair;
      const Played now = RunWith(present), then = RunWith(past);
      EXPECT_EQ(now.physics, then.physics) << "states, inputs, grants, statistics of bytes";
      EXPECT_EQ(now.world, then.world);
      const Measures a = MeasuresOf(now.recording), b = MeasuresOf(then.recording);
      EXPECT_EQ(a.error_own_m, b.error_own_m);
      EXPECT_EQ(a.error_server_m, b.error_server_m);
      EXPECT_EQ(a.bytes_per_s, b.bytes_per_s);
    }
  }
}

TEST(ShowAge, IsToldAndRunsForwardsAboutAsFastAsTime) {
  const Recording recording = RunWith(With("rally", "buffer", 8)).recording;
  float oldest = 0;
  int steps = 0, fast = 0;
  for (const auto& [peer, views] : recording.views) {
    std::map<PartId, double> first, before;
    for (const auto& [tick, view] : views) {
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        oldest = std::max(oldest, view.age[i]);
        if (peer == 0) {
          EXPECT_EQ(view.age[i], 0) << "the server shows the present";
        }
        const double moment = MomentShown(view, i);
        const auto last = before.find(view.id[i]);
        // At first it waits for its age.
        if (last != before.end() &&
            moment > first.try_emplace(view.id[i], last->second).first->second) {
          // It goes on faster, up to the tick, where it would overlap.
          const bool moves = std::hypot(view.vx[i], view.vy[i]) > 1;
          EXPECT_GE(moment - last->second, moves ? 1 - kUnseenShare - 1e-4 : -1e-4)
              << peer << " " << tick;
          EXPECT_LE(moment, static_cast<double>(tick));
          steps += 1;
          fast += moves && moment - last->second > 1 + kUnseenShare + 1e-4 ? 1 : 0;
        } else if (last != before.end()) {
          EXPECT_EQ(moment, last->second) << peer << " " << tick;
        }
        before[view.id[i]] = moment;
      }
    }
  }
  EXPECT_EQ(oldest, 8);
  EXPECT_LT(fast, steps / 20) << "it jumps ahead only where the two strike each other";
}

TEST(ShowAge, IsNotNoticedAtTheStartOrWhereNothingTouches) {
  Recording recording = RunWith(With("headon", "buffer", 8)).recording;
  recording.last_tick = recording.first_tick + 80;  // 20 ticks before they meet
  for (auto& [peer, views] : recording.views) {
    views.erase(views.upper_bound(recording.last_tick), views.end());
  }
  EXPECT_EQ(MeasuresOf(recording).seen, 0);
}

TEST(ShowAge, IsNoMoreThanInputsTake) {
  for (const auto& [impair, most] : {std::pair{"perfect", 4.0f}, std::pair{"cable", 7.0f}}) {
    ClusterConfig config = With("headon", "buffer", 8);
    config.impair = impair;
    const Recording recording = RunWith(config).recording;
    float oldest = 0;
    for (const auto& [tick, view] : recording.views.at(1)) {
      if (tick < 240) continue;  // it begins with the greatest
      oldest = std::max(oldest, *std::max_element(view.age.begin(), view.age.end()));
    }
    EXPECT_LE(oldest, most) << impair;
    EXPECT_GT(oldest, 0) << impair;
  }
}

TEST(ShowAge, ShowsOthersNearerToTheirTruePath) {
  for (const char* mode : {"buffer", "central"}) {
    const Measures now = MeasuresOf(RunWith(With("crossing", mode, 0)).recording);
    const Measures then = MeasuresOf(RunWith(With("crossing", mode, 8)).recording);
    EXPECT_LT(*then.path_error_rms_m, *now.path_error_rms_m) << mode;
    EXPECT_LT(*then.seen, *now.seen) << mode;
  }
}

TEST(ShowAge, IsToldOfInterpolatedBodiesToo) {
  const Recording recording = RunWith(With("crossing", "strict", 0)).recording;
  float oldest = 0;
  for (const auto& [tick, view] : recording.views.at(1)) {
    oldest = std::max(oldest, *std::max_element(view.age.begin(), view.age.end()));
  }
  EXPECT_GT(oldest, 4) << "two intervals, and the time that states travel";
}

}  // namespace show_age_cluster_test
}  // namespace seam
