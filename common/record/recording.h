#pragma once
/// A whole session in memory, decoded from a log: what measures and pictures are made of.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/record/recorder.h"

namespace seam {

/// One view of a peer at a tick, its parts put together.
struct Recording {
  Room room;                                          ///< the first of the log
  std::map<int, std::map<std::int64_t, View>> views;  ///< by peer, by tick; complete ones only
  /// When the bus heard each view, us: one clock for all peers. By peer, by tick; a recording that
  /// was not told has none.
  std::map<int, std::map<std::int64_t, std::int64_t>> view_us;
  std::map<int, std::map<std::int64_t, Inputs>> inputs;  ///< by player, by first_tick
  std::vector<States> states;                            ///< accepted ones, in log order
  std::vector<Grants> grants;                            ///< in log order
  std::map<std::int32_t, EditOrder> edits;               ///< by number: the room's order
  std::vector<Meta> meta;                                ///< in log order; the last value stands
  std::vector<Impacts> impacts;
  std::map<int, std::map<std::int64_t, Strands>> strands;  ///< by peer, by tick
  std::map<int, std::vector<Stats>> stats;                 ///< by peer, ascending
  std::vector<Load> loads;                                 ///< the server's, ascending
  std::vector<Event> events;

  std::int64_t events_read = 0;              ///< LCM events in the log
  std::int64_t foreign = 0;                  ///< events of channels that are not SEAM.*
  std::int32_t foreign_protocol = 0;         ///< of a room that another version recorded; 0: none
  std::int64_t undecodable = 0;              ///< events of SEAM.* that did not decode
  std::int64_t skipped_bytes = 0;            ///< damaged bytes of the log
  std::int64_t duplicates = 0;               ///< events heard twice, kept once
  std::int64_t bus_gaps = 0;                 ///< messages missing by their sequence numbers
  std::map<std::string, std::int64_t> gaps;  ///< the same by channel; channels without gaps absent
  std::int64_t first_tick = 0, last_tick = -1;  ///< over all views
};

/// Reads a log. `room` chooses one of several rooms ("" : the first). Throws OperatorError when
/// there is no such file or no room in it; damage is counted, not fatal.
Recording ReadRecording(const std::string& path, const std::string& room = "");

/// Adds one message to a recording (a live bus, a log). Accepts a late start, duplicates, and
/// messages out of order; a hostile log costs memory in proportion to its size, no more.
class RecordingBuilder {
 public:
  /// `room` "": the room of the first message that decodes.
  explicit RecordingBuilder(std::string room = "") : wanted_room_(std::move(room)) {}
  /// False when the message does not belong: foreign, undecodable, or a duplicate (each counted).
  /// `heard_us`: when the bus heard it, by its own clock; -1: not known.
  bool Add(const std::string& channel, ByteView message, std::int64_t heard_us = -1);
  /// Sorted by tick; the reference stays valid, but messages added later may be out of order in it
  /// until recording() is called again.
  Recording& recording();
  /// True once a Room was heard; without one nothing can be drawn.
  bool has_room() const { return has_room_; }

 private:
  /// What has come on a channel, by sequence number.
  struct Heard {
    std::int64_t first = -1, highest = -1;
    std::uint64_t mask = 0;                  ///< bit i: highest - i has come
    std::array<std::uint64_t, 64> hashes{};  ///< of the bytes, at sequence % 64
  };
  bool IsDuplicate(const std::string& channel, std::int64_t sequence, ByteView message);
  void CountGaps(const std::string& channel, std::int64_t more);
  bool Keep(Room& room);
  bool Keep(Inputs& inputs);
  bool Keep(States& states);
  bool Keep(Grants& grants);
  bool Keep(EditOrder& edit);
  bool Keep(Meta& meta);
  bool Keep(View& part);
  bool Keep(Impacts& impacts);
  bool Keep(Strands& strands);
  bool Keep(Stats& stats);
  bool Keep(Load& load);
  bool Keep(Event& event);
  bool KeepWhole(View& view);
  void DropStrayTicks();

  std::string wanted_room_;
  std::int64_t heard_us_ = -1;  // of the message that is being added
  bool has_room_ = false;
  bool sorted_ = true;
  Recording recording_;
  std::map<std::string, Heard> heard_;                                 ///< by channel
  std::map<std::pair<std::int64_t, int>, std::vector<View>> partial_;  ///< parts by tick and peer
};

/// A recording without a file: decodes what is published and keeps it.
class MemoryRecorder : public Recorder {
 public:
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  RecordingBuilder builder;
};

}  // namespace seam
