#include "server/room_feed.h"

#include "common/codec/message_limits.h"
#include "common/record/scene_parts.h"
#include "server/broadcast.h"

namespace seam {
namespace {

/// Time between two Rooms on the bus, us.
constexpr std::int64_t kRoomAgainUs = 1000000;
/// A log has one of so many rounds, for listeners who come late where it is played.
constexpr int kRoundsALogged = 30;
/// Time between two parts of a scene, us: 3 MB/s, and a logger reads each before the next comes.
/// The longest scene takes two seconds, and begins again with the Room after that.
constexpr std::int64_t kScenePartUs = 10000;

}  // namespace

RoomFeed::RoomFeed(const Room& room) : room_(room) {
  if (room.scene_text.size() <= kBusSceneBytesMax) return;
  parts_ = CutScene(room.scene_text);
  next_ = parts_.size();
  for (ScenePart& part : parts_) part.session = room.session;
  room_.scene_text.clear();
  room_.scene_text.shrink_to_fit();
}

void RoomFeed::Publish(std::int64_t now_us, Broadcast& broadcast) {
  const auto publish = [&](auto* message) {
    message->utime = now_us;
    if (round_ % kRoundsALogged == 0) {
      broadcast.Publish(*message);
    } else {
      broadcast.Repeat(*message);
    }
  };
  if (now_us - room_us_ >= kRoomAgainUs) {
    room_us_ = now_us;
    if (next_ >= parts_.size()) {
      ++round_;
      next_ = 0;
    }
    publish(&room_);
  }
  if (next_ >= parts_.size() || now_us - part_us_ < kScenePartUs) return;
  part_us_ = now_us;
  publish(&parts_[next_++]);
}

}  // namespace seam
