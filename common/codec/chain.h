#pragma once
/// Checksums of a recording, in the recording.

#include <cstdint>

namespace seam {

/// Bus only: CRC-32C of the messages that a peer has published since its last TickChain, and of the
/// bytes of the log since the last TickChain that a log wrote (docs/recordings.md, "Damage").
struct TickChain {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;
  std::int32_t messages = 0;  ///< since the peer's last TickChain; -1: not said
  std::int32_t messages_crc = 0;
  std::int32_t log_events = 0;  ///< this one included; 0: not written by a log
  std::int32_t log_crc = 0;  ///< the last bytes of an encoded TickChain: up to these, see RoomLog
};

}  // namespace seam
