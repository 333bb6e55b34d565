#pragma once
/// Gives a client the room's world of a tick that no input can change any more
/// (Replica::SettledWorld), so that its copies are the server's to the last bit: when it has become
/// ready, as states on the wire are rounded, and when copies differ.

#include <cstdint>
#include <map>
#include <vector>

#include "common/sync/replica.h"
#include "server/sessions/session_table.h"

namespace seam {

class SettledWorlds {
 public:
  /// Both must outlive this.
  SettledWorlds(const Replica& replica, SessionTable& sessions)
      : replica_(replica), sessions_(sessions) {}

  /// A client is ready. From the room's start on it has the same world anyway.
  void NoteReady(int peer) {
    if (replica_.tick() > 0) Owe(peer);
  }
  /// A client's copies differ from what was told, or it has told what differs from the server's.
  void NoteDiffering(int peer) { Owe(peer); }
  /// Sends what is due and settled by now, at most once a second to each, unless the line takes
  /// more than a quarter of a second for it: it would hold up other messages, and arrive when its
  /// tick can hardly be reached. Call after each tick.
  void Send(std::int64_t now_us);

 private:
  struct Owed {
    std::int64_t from = 0;   ///< not the world of an earlier tick
    std::int64_t news = -1;  ///< later tick of a further reason; -1: none
    std::int64_t at_us = 0;  ///< not before
    bool due = false;
  };
  void Owe(int peer);
  /// Returns the newest tick of which the inputs of all ready players are here.
  std::int64_t HeardUntil(std::int64_t now_us);
  /// Makes the pieces of a world of these ticks. Returns false as long as there is none.
  bool Pack(std::int64_t now_us, std::int64_t from, std::int64_t until);
  void SendTo(Session& session);

  static constexpr std::int64_t kNextWorldUs = 1000000;

  const Replica& replica_;
  SessionTable& sessions_;
  std::map<int, Owed> owed_;    // by peer
  std::vector<Chunk> pieces_;   // of the world packed last
  std::int64_t packed_us_ = 0;  // when
  std::int64_t packed_from_ = -1;
};

}  // namespace seam
