#pragma once
/// Where a peer's messages go to be seen: the LCM bus, a log file, memory, several, or nowhere.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/base/bytes.h"

namespace seam {

/// Longest channel name of LCM.
constexpr std::size_t kChannelBytesMax = 63;

class Recorder {
 public:
  virtual ~Recorder() = default;
  /// Publishes one encoded message. Never throws; failures are counted in failures().
  virtual void Publish(const std::string& channel, std::int64_t utime, ByteView message) = 0;
  virtual std::int64_t failures() const { return 0; }
};

/// To nowhere.
class NullRecorder : public Recorder {
 public:
  void Publish(const std::string&, std::int64_t, ByteView) override {}
};

/// To several, in order. Does not own them.
class TeeRecorder : public Recorder {
 public:
  void Add(Recorder* recorder) { to_.push_back(recorder); }
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override {
    for (Recorder* r : to_) r->Publish(channel, utime, message);
  }
  std::int64_t failures() const override {
    std::int64_t sum = 0;
    for (const Recorder* r : to_) sum += r->failures();
    return sum;
  }

 private:
  std::vector<Recorder*> to_;
};

/// "SEAM.<room>.<kind>" or "SEAM.<room>.<kind>.<peer>" when peer >= 0. kind is lower case: scene,
/// inputs, states, grants, meta, view, impacts, stats, event; docs/recordings.md lists them. Throws
/// OperatorError when `room` is not a name (1..32 characters of [A-Za-z0-9_-]).
std::string ChannelName(const std::string& room, const std::string& kind, int peer = -1);

}  // namespace seam
