#pragma once
/// Finds damage of a log by the checksums in it (seal_t, chain_t): ranges of ticks of which a
/// checksum is wrong.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "common/base/bytes.h"
#include "common/codec/codec.h"
#include "common/record/keyed_chain.h"
#include "common/record/log_place.h"

namespace seam {

struct LogEvent;

/// Part of a log in which something is not as it was written.
struct DamagedRange {
  std::int64_t first_tick = 0, last_tick = 0;
  bool to_the_end = false;         ///< nothing from first_tick on is certain
  /// All of it has its checksums, but not those of the key: somebody else wrote it.
  bool forged = false;
  bool missing = false;            ///< nothing of these ticks is there, though all around is whole
  std::set<std::string> channels;  ///< of the events in it; one or several of them are damaged
};

/// Returns the checksum of messages and one more after them: CRC-32C of channels and bytes.
std::int32_t ChainedCrc(std::int32_t crc, const std::string& channel, ByteView message);

/// Gets a log from its begin to its end.
///
/// A log that RoomLog wrote is checked byte by byte. Any other (of a stock lcm-logger) has events
/// with other numbers and times, and maybe not all of them: the messages of each publisher are
/// checked where all of them are there.
class ChainCheck {
 public:
  /// `from`: the place of the first event. With `key` the log must be one that was written with it,
  /// from there on and without anything before. A log that begins with a later segment is checked
  /// from that on.
  explicit ChainCheck(const LogPlace& from = LogPlace(), const Secret* key = nullptr);
  /// The next event begins another segment, which has to go on from here.
  void BeginSegment() { own_crc_ = crc_; }
  /// Notes bytes that belong to no event.
  void NoteSkipped() { skipped_ = true; }
  /// Notes an event, with the bytes of its header.
  void Note(ByteView header, const LogEvent& event);
  /// Returns the damaged parts so far, in the order of the log. Call after the last event.
  std::vector<DamagedRange> Damage() const;
  /// Returns the tick before a log that begins with a later segment; nullopt: it does not.
  std::optional<std::int64_t> begins_after() const { return begins_after_; }
  /// True if all bytes before the last seal of a log are as they were written.
  bool intact() const { return bytes_damage_.empty() && !damaged_; }

 private:
  /// The messages heard of a publisher since its last seal.
  struct Heard {
    std::int64_t messages = 0, tick = -1;
    std::int32_t crc = 0;
    std::set<std::string> channels;
  };
  /// The fields of a LogSeal, or of a TickChain of 0.25.
  struct Seal;
  /// Adds an event's bytes, without the last ones, to the keyed hash.
  static void AddEvent(ByteView header, const LogEvent& event, std::size_t without,
                       KeyedChain* chain);
  /// True if the bytes up to this seal are as the holder of the key wrote them, or there is no key.
  bool KeyedAsWritten(ByteView header, const LogEvent& event, const Seal& seal);
  static std::optional<Seal> SealOf(const AnyMessage& message);
  using Publisher = std::tuple<std::string, std::int64_t, int>;  // room, session, peer
  void CheckMessages(const Publisher& publisher, const Seal& seal);
  void CheckBytes(ByteView header, const LogEvent& event, const Seal& seal);

  std::map<Publisher, Heard> heard_;
  std::vector<DamagedRange> messages_damage_;

  // Since the last seal of a log.
  std::uint32_t crc_;          // continued from it
  std::uint32_t own_crc_ = 0;  // begun anew, as by a log that was appended to another
  std::int64_t events_ = 0;
  bool skipped_ = false;
  bool first_;  // nothing came yet, and the log before is not known
  std::optional<std::int64_t> begins_after_;
  std::set<std::string> channels_;
  std::int64_t tick_ = -1;  // of the last good one
  std::int64_t server_tick_ = -1, server_session_ = 0;  // of the server's last good one

  /// Notes the ticks between the server's last good seal and this one, of the same session: a disk
  /// that was full takes nothing, and a room goes on.
  void NoteHole(const Seal& seal);
  /// Ends the damaged part that began after tick_, if there is one.
  void CloseDamage(std::int64_t last_tick);

  std::optional<Secret> key_;
  std::optional<KeyedChain> keyed_;  // since the last seal of a log

  bool damaged_ = false;  // something since tick_
  bool forged_ = true;    // no checksum since is wrong, but for those of the key
  std::set<std::string> damaged_channels_;
  bool sealed_ = false;  // a RoomLog wrote this
  std::vector<DamagedRange> bytes_damage_;
};

}  // namespace seam
