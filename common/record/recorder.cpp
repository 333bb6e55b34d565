#include "common/record/recorder.h"

#include <cstdlib>

#include "common/base/check.h"
#include "common/base/names.h"
#include "common/codec/codec.h"

namespace seam {

void Recorder::EndTick(const std::string& channel, const LogSeal& seal, bool kept) {
  if (kept) Publish(channel, seal.utime, Encode(seal));
}

std::string ChannelName(const std::string& room, const std::string& kind, int peer) {
  if (!IsName(room)) {
    throw OperatorError("room \"" + room + "\": a name is 1..32 characters of [A-Za-z0-9_-]");
  }
  SEAM_ASSERT(IsName(kind));
  std::string name = "SEAM." + room + "." + kind;
  if (peer >= 0) name += "." + std::to_string(peer);
  SEAM_ASSERT(name.size() <= kChannelBytesMax);
  return name;
}

std::string RoomOfChannel(const std::string& channel) {
  if (channel.compare(0, 5, "SEAM.") != 0) return "";
  const std::size_t end = channel.find('.', 5);
  return end == std::string::npos ? "" : channel.substr(5, end - 5);
}

int PublisherOfChannel(const std::string& channel) {
  const std::string room = RoomOfChannel(channel);
  if (room.empty()) return -1;
  const std::string rest = channel.substr(room.size() + 6);  // after "SEAM." and the next point
  const std::size_t point = rest.find('.');
  const std::string kind = rest.substr(0, point);
  bool own = false;
  for (const char* each : {"view", "strands", "impacts", "stats", "event", "chain", "divergence"}) {
    own = own || kind == each;
  }
  return own && point != std::string::npos ? std::atoi(rest.c_str() + point + 1) : 0;
}

}  // namespace seam
