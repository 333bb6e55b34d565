#pragma once
/// A running session as a stream of events for pages: its beginning for a watcher that comes, then
/// new worlds, frames of views, counters and marks, within a budget of bytes.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/record/recording.h"
#include "render/page/events.h"
#include "render/page/worlds.h"
#include "render/playback/playback.h"
#include "render/playback/stray_ticks.h"
#include "render/view/event_ring.h"
#include "render/view/live_errors.h"
#include "render/view/view_deltas.h"

namespace seam {

/// Most bytes that a watcher is sent each second, besides its beginning.
constexpr double kLiveBytesPerS = 180000;

class LiveFeed {
 public:
  /// `room` "": the room that is heard first. `player`: the one whom the pages may drive; "": none.
  LiveFeed(std::string room, std::string player, double bytes_per_s = kLiveBytesPerS);

  /// Simulates each session that is heard from its begin in one world, beside it, and tells the
  /// pages the error of each view. Costs as much as a peer that simulates everything.
  void MeasureErrors() { measures_ = true; }

  /// Tells the pages the present values of what an operator changes, as JSON; "": not known.
  void ShowControl(const std::string& json);
  /// Adds a message of the bus; returns false when it does not belong to the session. A Room of
  /// another session begins that session.
  bool Add(const std::string& channel, ByteView message);
  /// Drops what no page needs any more. Call it now and then while reading an old log.
  void Prune();
  /// Makes events of what has come, about thirty times a second. Where the budget does not suffice
  /// it leaves out ticks, by turns of the peers, and the pages interpolate.
  void Flush(std::int64_t now_us);

  /// Returns the next event for a watcher and moves its place, 0 for a new one; nullptr: none yet.
  EventRing::Piece Next(std::uint64_t* place);
  /// Returns the bytes of all events so far, without beginnings.
  std::int64_t bytes() const { return ring_.bytes(); }
  /// True once a session has been heard whose scene is known.
  bool begun() const { return playback_ != nullptr; }
  const std::string& player() const { return player_; }

 private:
  struct PeerFeed {
    ViewDeltas deltas;
    std::int64_t sent_tick = -1;
    bool alone = true;     // its next frame has to stand for itself
    bool skipped = false;  // for lack of bytes, at the last flush
  };

  void Begin();
  void Restart();
  std::string Start();
  bool IsStray(std::int64_t tick);
  ViewFrame FrameOf(const View& view);
  ViewFrame FrameOfMotions(std::int64_t tick);
  void PutViews(int peer, std::int64_t newest_tick, PageBytes* frames);
  void AddEvents();
  void AddStats();
  void AddErrors();
  std::string ErrorsJson(std::size_t from) const;
  void HearForErrors();
  void NoteHandOvers(const View& view);
  void NoteSaid();

  const std::string room_, player_;
  const double bytes_per_s_;
  RecordingBuilder builder_;
  std::unique_ptr<Playback> playback_;  // of builder_'s recording; nullptr: no session yet
  std::unique_ptr<PageWorlds> worlds_;
  std::map<int, PeerFeed> peers_;
  PeerFeed motions_;  // kinematic bodies, as a peer of their own
  std::vector<PageEvent> events_;
  std::size_t events_sent_ = 0;
  int edits_seen_ = -1;
  std::int64_t impacts_tick_ = 0;            // impacts up to it are in events_
  std::map<int, int> owners_;                // by body, in the server's newest view
  std::map<int, std::int64_t> stats_ticks_;  // of the newest counters sent, by peer
  bool measures_ = false;                    // errors are wanted
  bool too_late_ = false;                    // this session's begin was not heard
  std::unique_ptr<LiveErrors> errors_;       // nullptr: not wanted, too late or no session
  std::string control_;                      // the present values; "": not known
  EventRing ring_;
  StrayTicks ticks_;
  std::int64_t flushed_us_ = 0;
  double credit_ = 0;  // bytes
  int turn_ = 0;       // the peer that goes first at the next flush
};

/// Stands for the peer of frames that hold the scene's kinematic bodies.
constexpr int kMotionsPeer = 1024;

}  // namespace seam
