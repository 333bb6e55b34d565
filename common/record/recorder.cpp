#include "common/record/recorder.h"

#include "common/base/check.h"
#include "common/base/names.h"

namespace seam {

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

}  // namespace seam
