#pragma once
/// Gives a client the room's world of a tick that no input can change any more
/// (Replica::SettledWorld), so that its copies are the server's to the last bit: when it has become
/// ready, as states on the wire are rounded, and when copies differ.

#include <cstdint>
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
  /// more than half a second for it: it would arrive when its tick can hardly be reached. Call
  /// after each tick.
  void Send(std::int64_t now_us);

 private:
  struct Owed {
    int peer = -1;
    std::int64_t from = 0;   ///< not the world of an earlier tick
    std::int64_t news = -1;  ///< later tick of a further reason; -1: none
    std::int64_t at_us = 0;  ///< not before
    bool due = false;
  };
  void Owe(int peer);
  /// Returns the newest tick of which the inputs of all ready players are here.
  std::int64_t HeardUntil() const;
  void SendSince(std::int64_t now_us, std::int64_t from);
  void SendTo(Session& session, const std::vector<Chunk>& pieces);

  static constexpr std::int64_t kNextWorldUs = 1000000;

  const Replica& replica_;
  SessionTable& sessions_;
  std::vector<Owed> owed_;  // few
};

}  // namespace seam
