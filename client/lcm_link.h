#pragma once
/// A client's end of a scene's [lcm]: drives by messages of another program, and publishes the
/// poses that it shows.

#include <cstdint>
#include <optional>
#include <string>

#include "client/client.h"
#include "common/base/progress_line.h"
#include "common/record/lcm_inbox.h"
#include "common/sync/show/pose_publisher.h"

namespace seam {

class LcmLink {
 public:
  /// `bus` must outlive it. `drive`: the channel to drive by, "": the scene's for this player.
  LcmLink(Bus& bus, std::string drive);

  /// Call after Client::Tick: opens the scene's channels once there is a scene, and publishes the
  /// poses that are due. Returns one line if the scene has no channel to drive by.
  Status Follow(const Client& client);
  /// Takes the messages that have come. Returns the inputs of the newest; none if that is older
  /// than kStaleUs.
  Input Read(std::int64_t now_us);
  /// Prints lines about refused messages, each once.
  void Report(const char* program, ProgressLine& line);

  /// A program that has died must not drive on; a live one says its inputs ten times in it, us.
  static constexpr std::int64_t kStaleUs = 500000;
  /// Messages a second, and at once: as many as the fastest scene has ticks.
  static constexpr double kDrivesPerS = 1000, kDrivesAtOnce = 1000;

 private:
  Status Open(const Scene& scene, const std::string& name);

  Bus& bus_;
  const std::string drive_;
  LcmInbox inbox_;
  std::optional<PosePublisher> poses_;  // once there is a scene
  Input newest_;
  std::int64_t heard_us_ = 0;  // time of the newest; 0: none
  std::int64_t now_us_ = 0;
};

}  // namespace seam
