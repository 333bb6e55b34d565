#pragma once
/// A whole session in memory, decoded from a log: what measures and pictures are made of.

#include <map>
#include <string>
#include <vector>

#include "common/codec/messages.h"
#include "common/record/recorder.h"

namespace seam {

/// One view of a peer at a tick, its parts put together.
struct Recording {
  Room room;                                        ///< the first of the log
  std::map<int, std::map<std::int64_t, View>> views;   ///< by peer, by tick; complete ones only
  std::map<int, std::map<std::int64_t, Inputs>> inputs;  ///< by player, by first_tick
  std::vector<States> states;                       ///< accepted ones, in log order
  std::vector<Grants> grants;                       ///< in log order
  std::vector<Impacts> impacts;
  std::map<int, std::vector<Stats>> stats;          ///< by peer, ascending
  std::vector<Event> events;

  std::int64_t events_read = 0;        ///< LCM events in the log
  std::int64_t foreign = 0;            ///< events of channels that are not SEAM.*
  std::int64_t undecodable = 0;        ///< events of SEAM.* that did not decode
  std::int64_t skipped_bytes = 0;      ///< damaged bytes of the log
  std::int64_t bus_gaps = 0;           ///< messages missing by their sequence numbers
  std::int64_t first_tick = 0, last_tick = -1;  ///< over all views
};

/// Reads a log. `room` chooses one of several rooms ("" : the first). Throws OperatorError when
/// there is no such file or no room in it; damage is counted, not fatal.
Recording ReadRecording(const std::string& path, const std::string& room = "");

/// Adds one message to a recording (a live bus, a log): false when it does not belong.
class RecordingBuilder {
 public:
  explicit RecordingBuilder(std::string room = "") : wanted_room_(std::move(room)) {}
  bool Add(const std::string& channel, ByteView message);
  Recording& recording() { return recording_; }
  bool has_room() const { return has_room_; }

 private:
  std::string wanted_room_;
  bool has_room_ = false;
  Recording recording_;
  std::map<std::string, std::int32_t> last_sequence_;
  std::map<std::pair<int, std::int64_t>, std::vector<View>> partial_;
};

/// Decodes and keeps nothing but what it publishes, in memory: a recording without a file.
class MemoryRecorder : public Recorder {
 public:
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  RecordingBuilder builder;
};

}  // namespace seam
