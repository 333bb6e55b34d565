#include "common/sync/show/pose_publisher.h"

#include <algorithm>
#include <cmath>

#include "common/codec/lcm_types.h"
#include "common/physics/part_places.h"
#include "common/scene/lcm/lcm_tables.h"

namespace seam {

bool PosePublisher::Publishes(const Scene& scene) const {
  const std::vector<LcmPublishing>& all = scene.lcm->publish;
  return std::any_of(all.begin(), all.end(),
                     [this](const LcmPublishing& one) { return one.player == player_; });
}

void PosePublisher::Publish(const World& world, std::int64_t tick, std::int32_t peer,
                            std::int64_t utime, const std::function<BodyState(int body)>& read) {
  const Scene& scene = world.scene();
  // A client that joins anew may go back.
  const std::int64_t before = last_tick_ >= 0 && last_tick_ < tick ? last_tick_ : tick - 1;
  last_tick_ = tick;
  for (const LcmPublishing& publishing : scene.lcm->publish) {
    const auto periods = [&](std::int64_t at) {
      return std::floor(static_cast<double>(at) * publishing.rate_hz / scene.solver.tick_hz);
    };
    if (publishing.player != player_ || !(periods(tick) > periods(before))) continue;
    for (const PartId part : publishing.parts) {
      BodyState state;
      if (!ReadPart(world, part, read, &state)) continue;
      LcmPose pose{utime, tick, peer, scene.parts[static_cast<std::size_t>(part)].name};
      pose.x = static_cast<double>(state.position.x());
      pose.y = static_cast<double>(state.position.y());
      pose.angle = static_cast<double>(state.angle);
      pose.vx = static_cast<double>(state.velocity.x());
      pose.vy = static_cast<double>(state.velocity.y());
      pose.spin = static_cast<double>(state.spin);
      recorder_.Publish(publishing.channel, utime, Encode(pose));
    }
  }
}

}  // namespace seam
