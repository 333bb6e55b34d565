#pragma once
/// Checksums of a recording, in the recording, and where its ticks end.

#include <cstdint>
#include <optional>
#include <vector>

namespace seam {

/// Most ticks in a seal, normal 15: more would name damage by longer ranges.
constexpr int kSealTicksMax = 60;

/// Bytes of LogSeal::log_keyed, if there are any.
constexpr std::size_t kLogKeyedBytes = 32;

/// Bus only: CRC-32C of the messages that a peer has published since its last LogSeal, and of the
/// bytes of the log since the last LogSeal that a log wrote (docs/recordings.md, "Damage").
/// Recordings of 0.25 have a TickChain for each tick instead.
struct LogSeal {
  std::int64_t utime = 0;
  std::int64_t session = 0;
  std::int32_t sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;
  std::int32_t messages = 0;  ///< since the peer's last LogSeal; -1: not said
  std::int32_t messages_crc = 0;
  std::vector<std::uint8_t> ticks;  ///< of the server; PackTicks
  std::int32_t log_events = 0;      ///< this one included; 0: not written by a log
  std::vector<std::uint8_t> log_keyed;  ///< of KeyedChain, behind all but log_crc; {}: no key
  std::int32_t log_crc = 0;  ///< the last bytes of an encoded LogSeal: up to these, see RoomLog
};

/// A tick of the server in its log.
struct SealedTick {
  std::int64_t tick = 0;
  std::int32_t before = 0, after = 0;  ///< the server's messages before its step, and from there on
  std::uint16_t hash = 0;              ///< the lowest bits of World::Hash after it
};

/// Returns `ticks` of a seal. Requires ticks without gaps, and at most kSealTicksMax.
std::vector<std::uint8_t> PackTicks(const std::vector<SealedTick>& ticks);
/// Returns the ticks of a seal, ascending up to `seal.tick`; nullopt if the bytes are malformed.
std::optional<std::vector<SealedTick>> TicksOf(const LogSeal& seal);

}  // namespace seam
