#pragma once
/// Publishes the poses of parts on the LCM channels of a scene ([[lcm.publish]]).

#include <cstdint>
#include <functional>

#include "common/physics/world.h"
#include "common/record/recorder.h"

namespace seam {

class PosePublisher {
 public:
  /// Publishes for this player's client; -1: for the server.
  PosePublisher(Recorder& recorder, int player) : recorder_(recorder), player_(player) {}

  /// Publishes the poses that are due at a tick: those of rate R at each tick t at which
  /// floor(t R / tick_hz) grows; once if there are several since the last call. `read`: the state
  /// of a body.
  void Publish(const World& world, std::int64_t tick, std::int32_t peer, std::int64_t utime,
               const std::function<BodyState(int body)>& read);
  /// True if a scene has anything to publish here.
  bool Publishes(const Scene& scene) const;

 private:
  Recorder& recorder_;
  const int player_;
  std::int64_t last_tick_ = -1;
};

}  // namespace seam
