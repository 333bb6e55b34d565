#pragma once
/// The log of the server alone, as --state writes it.

#include <cstdint>
#include <string>

#include "common/record/room_log.h"

namespace seam {

class ServerLog : public Recorder {
 public:
  explicit ServerLog(const std::string& path, std::int64_t segment_bytes = 0,
                     DiskThread* disk = nullptr)
      : log(path, true, disk, nullptr, segment_bytes) {}
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override {
    if (PublisherOfChannel(channel) == 0) log.Publish(channel, utime, message);
  }
  void EndTick(const std::string& channel, const LogSeal& seal, bool kept) override {
    if (seal.peer == 0) log.EndTick(channel, seal, kept);
  }
  RoomLog log;
};

}  // namespace seam
