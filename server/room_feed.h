#pragma once
/// Publishes the room on the bus, again and again: a logger that begins late needs it, too.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/codec/scene_part.h"

namespace seam {

class Broadcast;

class RoomFeed {
 public:
  explicit RoomFeed(const Room& room);
  /// Publishes what is due: the Room each second, and if its scene is too long for a message, the
  /// scene's parts after it, one at a time, so that no burst overruns a logger. One in 30 is
  /// logged. To be called often.
  void Publish(std::int64_t now_us, Broadcast& broadcast);

 private:
  Room room_;                     // without a scene that is too long
  std::vector<ScenePart> parts_;  // of that scene
  std::size_t next_ = 0;          // the part to publish next
  int round_ = -1;                // how often all of them were published before
  std::int64_t room_us_ = -1000000000, part_us_ = -1000000000;
};

}  // namespace seam
