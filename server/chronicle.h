#pragma once
/// The one place that a room's events go out from, and the sum of its session.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/topology/edit.h"

namespace seam {

class Broadcast;
class Replica;
class Rules;
class SessionTable;
class TrustLadder;

class Chronicle {
 public:
  /// All must outlive this object.
  Chronicle(const Room& room, const Replica& replica, SessionTable& sessions, Broadcast& broadcast)
      : room_(room), replica_(replica), sessions_(sessions), broadcast_(broadcast) {}

  /// Publishes an event with time and tick, on the bus only, and returns it. Of each kind kPerS a
  /// second are published, and kEventBurst at once; more are only counted.
  Event Say(std::int64_t now_us, Event event);
  void SayResumed(std::int64_t now_us);
  /// To be called before an edit is applied: counts it, says broken joints and seats.
  void NoteEdit(std::int64_t now_us, const Edit& edit);
  /// Says changed scores.
  void NoteValues(std::int64_t now_us, const Meta& meta);
  /// A session became ready, or left. Returns true if its client had been here before.
  bool NoteReady(const std::string& name);
  void NoteLeft(const std::string& name);
  /// Counts a tick that was `late_us` late.
  void NoteTick(std::int64_t late_us);
  /// Counts the changes of authority since the last call; those by an edit do not count.
  void CountHandOvers();
  std::int64_t hand_overs() const { return hand_overs_; }

  /// Sums up the session. `rules`: nullptr if the room has none.
  Summary Sum(std::int64_t now_us, Ended ended, const TrustLadder& ladder, const Rules* rules);
  /// True each kSumUs, at once after SumSoon, and kSumSoonUs after a client came or went: so that
  /// the last sum of a killed session names them all.
  bool SumIsDue(std::int64_t now_us) const {
    return now_us - summed_us_ >= (changed_ ? kSumSoonUs : kSumUs);
  }
  void SumSoon() { summed_us_ = -kSumUs; }
  void Publish(std::int64_t now_us, const Summary& summary);
  /// Completes the last sum of the session that was killed, by the world that is resumed, and
  /// publishes it. `present`: the players that were in the room.
  void SumKilled(std::int64_t now_us, Summary last, const std::vector<int>& present,
                 const Rules* rules);

  /// Keeps events for TakeEvents.
  void Keep() { keeps_ = true; }
  std::vector<Event> TakeEvents() { return std::exchange(kept_, {}); }
  /// Returns the sums of sessions that have ended, since the last call.
  std::vector<Summary> TakeEnded() { return std::exchange(ended_, {}); }

  /// More than people read; a script in a loop, or a falling wall, says thousands.
  static constexpr int kPerS = 20, kEventBurst = 60;
  static constexpr std::int64_t kSumUs = 10000000, kSumSoonUs = 100000;

 private:
  /// Events that a kind may still say.
  struct Allowance {
    double events = kEventBurst;
    std::int64_t at_us = 0;
  };
  std::string NameOf(int player) const;
  void SayBroken(std::int64_t now_us, int joint);
  void SaySeat(std::int64_t now_us, const SeatEdit& seat);

  const Room& room_;
  const Replica& replica_;
  SessionTable& sessions_;
  Broadcast& broadcast_;
  std::array<Allowance, kEventKindMax + 1> allowances_;
  std::int64_t events_ = 0, dropped_ = 0, edits_ = 0, ticks_ = 0, late_ticks_ = 0;
  std::int64_t hand_overs_ = 0;
  int revision_ = -1;         // edits applied when holders_ was read
  std::vector<int> holders_;  // rebuilt for each revision, by mechanism: at the last call
  std::int64_t summed_us_ = -kSumUs;
  bool changed_ = false;  // a client came or went since the last sum
  bool keeps_ = false;
  std::vector<Event> kept_;
  std::vector<Summary> ended_;
};

}  // namespace seam
