#pragma once
/// A whole session in memory, decoded from a log; the input of measures and pictures.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/record/chain_check.h"
#include "common/record/log_sessions.h"
#include "common/record/recorder.h"
#include "common/record/scene_parts.h"

namespace seam {

/// The messages of one session of a room, by kind, and counters of damage.
struct Recording {
  Room room;                                          ///< the session's first, with its scene
  std::map<int, std::map<std::int64_t, View>> views;  ///< by peer, by tick; complete ones only
  /// Times at which the bus received each view, us on one clock for all peers. By peer, by tick;
  /// empty if unknown.
  std::map<int, std::map<std::int64_t, std::int64_t>> view_us;
  std::map<int, std::map<std::int64_t, Inputs>> inputs;  ///< by player, by first_tick
  std::vector<States> states;                            ///< accepted ones, in log order
  std::vector<Grants> grants;                            ///< in log order
  std::map<std::int32_t, EditOrder> edits;               ///< by number: the room's order
  std::vector<Meta> meta;                                ///< in log order; the last value counts
  std::vector<Impacts> impacts;
  std::map<int, std::map<std::int64_t, Strands>> strands;  ///< by peer, by tick
  std::map<int, std::vector<Stats>> stats;                 ///< by peer, ascending
  std::vector<Load> loads;                                 ///< the server's, ascending
  std::vector<Event> events;
  std::vector<Summary> summaries;  ///< in log order
  std::vector<Audit> audits;  ///< by tick
  std::vector<Divergence> divergences;  ///< by tick

  std::vector<LogSession> sessions;          ///< all of the room in the log, this one among them
  bool mixed = false;                        ///< holds several sessions that have no number
  std::int64_t events_read = 0;              ///< LCM events in the log
  std::int64_t foreign = 0;                  ///< events of other channels, rooms or sessions
  std::int32_t foreign_protocol = 0;         ///< protocol of an unreadable room; 0: none
  std::int64_t undecodable = 0;              ///< events of SEAM.* that did not decode
  std::int64_t skipped_bytes = 0;            ///< damaged bytes of the log
  std::vector<DamagedRange> damage;          ///< parts of the log with wrong checksums
  std::int64_t duplicates = 0;               ///< events received twice, kept once
  std::int64_t bus_gaps = 0;                 ///< messages missing by their sequence numbers
  std::map<std::string, std::int64_t> gaps;  ///< the same by channel; channels without gaps absent
  std::int64_t first_tick = 0, last_tick = -1;  ///< over all views
};

/// Reads one session of a log. `room` selects one of several rooms ("": the first), `session` one
/// of several sessions of the room, as for ChooseSession. Throws OperatorError when there is no
/// such file, room or session, or when sessions of before protocol 13 cannot be told apart; damage
/// is counted, not fatal.
Recording ReadRecording(const std::string& path, const std::string& room = "",
                        const std::string& session = "");

/// Returns "#2" for the second session of its log, "" for the only one.
std::string SessionSuffix(const Recording& recording);
/// Returns a line for the operator if the log has several sessions: "2 sessions: ...; this is 2,
/// the last (--session chooses)"; else "".
std::string ChosenSession(const Recording& recording);

/// A number of a message that is so far ahead of the one before comes from a publisher that was
/// restarted, or from damage: that many messages are not lost one after another.
constexpr std::int64_t kNumbersAheadMax = 100000;

/// Builds a recording message by message, from a live bus or a log. Accepts a late start,
/// duplicates, and messages out of order; a hostile log costs memory in proportion to its size.
class RecordingBuilder {
 public:
  /// `room` "": the room of the first message that decodes. Without a `session` the builder follows
  /// the newest: the Room of one that it has not heard before empties the recording.
  explicit RecordingBuilder(std::string room = "",
                            std::optional<std::int64_t> session = std::nullopt)
      : wanted_room_(std::move(room)), session_(session), follows_newest_(!session) {}
  /// Adds a message. Returns false and counts it if it is foreign, undecodable, or a duplicate.
  /// `heard_us`: time of receipt on the bus's clock; -1: unknown.
  bool Add(const std::string& channel, ByteView message, std::int64_t heard_us = -1);
  /// Returns the recording, sorted by tick. The reference stays valid, but later messages may be
  /// out of order in it until recording() is called again.
  Recording& recording();
  /// Returns the session that is recorded; nullopt before the first message.
  std::optional<std::int64_t> session() const { return session_; }
  /// Returns true once a Room was received.
  bool has_room() const { return has_room_; }
  /// Returns true once its scene was received, too, which may follow in parts; without it nothing
  /// can be drawn.
  bool has_scene() const { return has_room_ && !recording_.room.scene_text.empty(); }
  /// Returns the parts of the scene that have come, if it comes in parts.
  const SceneParts& scene_parts() const { return scene_parts_; }

 private:
  /// The sequence numbers received on a channel.
  struct Heard {
    std::int64_t first = -1, highest = -1;
    std::uint64_t mask = 0;                  ///< bit i: highest - i was received
    std::array<std::uint64_t, 64> hashes{};  ///< hash of each message, at sequence % 64
  };
  template <class Message>
  bool IsOfSession(const Message& message);
  bool IsDuplicate(const std::string& channel, std::int64_t sequence, ByteView message);
  void CountGaps(const std::string& channel, std::int64_t more);
  bool Keep(Room& room);
  bool Keep(ScenePart& part);
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
  bool Keep(Summary& summary);
  bool Keep(TickChain&) { return true; }  // LogReader has checked it
  bool Keep(LogSeal&) { return true; }
  bool Keep(Accepted&) { return true; }  // for replays of the room
  bool Keep(Audit& audit);
  bool Keep(Divergence& divergence);
  bool KeepWhole(View& view);
  /// Keeps the views before this one that were not sent, as they are like the last one.
  void KeepUnmoved(const View& view);
  void AddScene();
  void DropStrayTicks();

  std::string wanted_room_;
  std::optional<std::int64_t> session_;
  bool follows_newest_;
  std::set<std::int64_t> ended_;  // sessions before session_
  std::int64_t room_sequence_ = 0;
  std::int64_t heard_us_ = -1;  // time of receipt of the message being added
  bool has_room_ = false;
  SceneParts scene_parts_;
  bool sorted_ = true;
  Recording recording_;
  std::map<std::string, Heard> heard_;                                 ///< by channel
  std::map<std::pair<std::int64_t, int>, std::vector<View>> partial_;  ///< parts by tick and peer
};

/// A recording without a file: decodes and keeps all published messages.
class MemoryRecorder : public Recorder {
 public:
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  RecordingBuilder builder;
};

}  // namespace seam
