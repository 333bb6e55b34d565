#pragma once
/// The interface to which a peer publishes its messages: the LCM bus, a log file, or memory.

#include <cstddef>
#include <cstdint>
#include <string>

#include "common/base/bytes.h"
#include "common/codec/log_seal.h"

namespace seam {

/// Longest channel name of LCM.
constexpr std::size_t kChannelBytesMax = 63;

class Recorder {
 public:
  virtual ~Recorder() = default;
  /// Publishes one encoded message. Never throws; failures are counted in failures().
  virtual void Publish(const std::string& channel, std::int64_t utime, ByteView message) = 0;
  /// Publishes a message once more, for late listeners: on a bus alone. It has the number
  /// -1 and belongs to no seal.
  virtual void Repeat(const std::string&, std::int64_t, ByteView) {}
  /// Ends a peer's tick. `seal` is of its messages since the last one that was `kept`; only those
  /// are published. A log adds the checksum of its bytes, and passes them all to the operating
  /// system, ending with the seal; a later one takes the place of a seal that is not kept.
  virtual void EndTick(const std::string& channel, const LogSeal& seal, bool kept);
  virtual std::int64_t failures() const { return 0; }
  /// Returns false if published messages have no receiver and may be skipped.
  virtual bool listening() const { return true; }
};

/// Returns "SEAM.<room>.<kind>", or "SEAM.<room>.<kind>.<peer>" if peer >= 0. Kinds are lower case:
/// scene, inputs, states, grants, edit, meta, view, impacts, stats, event ... (docs/recordings.md).
/// Throws OperatorError when `room` is not a name (1..32 characters of [A-Za-z0-9_-]).
std::string ChannelName(const std::string& room, const std::string& kind, int peer = -1);
/// Returns the room of such a name; "" if the channel is not one of ours.
std::string RoomOfChannel(const std::string& channel);
/// Returns the peer that publishes on such a channel: 0, the server, but for the kinds of which
/// each peer publishes its own. -1 if the channel is not one of ours.
int PublisherOfChannel(const std::string& channel);

}  // namespace seam
