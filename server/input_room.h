#pragma once
/// The server's part in a room whose peers send each other inputs alone (Policy::InputsOnly):
/// writes the inputs of players without a client, gives its world to each client that joins, finds
/// worlds that have parted, and chooses the input delay where the mode adapts it.
///
///   player absent    the server writes neutral inputs, kAhead ticks ahead
///   client ready     at the next barrier: inputs written up to a tick --> world, with them --> the
///                    client goes on from that world, and writes its inputs from the next tick on
///   client leaves    the server goes on writing behind the newest input that has arrived

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/sync/replica.h"
#include "server/broadcast.h"
#include "server/delay_chooser.h"
#include "server/delay_history.h"
#include "server/edits/edit_log.h"
#include "server/room_clock.h"
#include "server/sessions/session_table.h"

namespace seam {

class InputRoom {
 public:
  /// All must outlive this.
  InputRoom(const SyncConfig& config, Replica& replica, SessionTable& sessions,
            Broadcast& broadcast);

  /// A client is ready and needs the world. `player`: -1 if it only watches.
  void NoteReady(int peer) { awaits_world_.push_back(peer); }
  void NoteLeft(int player);
  /// Writes the next inputs of absent players. Call before a tick.
  void WriteAbsent(std::int64_t now_us);
  /// Gives the world to the waiting clients, if this tick is a barrier. Call after each tick, and
  /// before WriteAbsent. `edits`: see EditLog::History.
  void GiveWorlds(std::int64_t now_us, const EditLog& edits);

  /// Notes a player's new inputs as they arrive.
  void NoteArrived(std::int64_t now_us, const Inputs& fresh);
  /// Notes the times of the ticks that are due by now, at which clients read inputs.
  void NoteDue(std::int64_t now_us, const RoomClock& clock);
  /// Returns the new input delay once it should change, ticks.
  std::optional<int> ChooseDelay();
  /// The event of that change: the delay counts, also for later clients.
  void NoteDelay(int ticks);

  /// Compares a client's world with the server's at the tick of its ping. True if they differ.
  bool HasParted(const Ping& ping) const;
  /// Counts a client with a parted world.
  void NoteParted() { ++parted_; }
  int parted() const { return parted_; }

  /// Ticks that the server writes ahead for an absent player: no peer has to wait for them.
  static constexpr std::int64_t kAhead = 24;

 private:
  void Write(std::int64_t now_us, int player, std::int64_t up_to);
  bool GiveWorld(std::int64_t now_us, const EditLog& edits, Session& session);

  const SyncConfig& config_;
  Replica& replica_;
  SessionTable& sessions_;
  Broadcast& broadcast_;
  std::vector<char> present_;      // by player: its client writes its inputs
  std::vector<int> awaits_world_;  // peers
  DelayHistory delays_;
  DelayChooser chooser_;
  std::int64_t chosen_tick_ = 0;
  static constexpr std::int64_t kDueKept = 256;  ///< ticks
  std::array<std::int64_t, kDueKept> due_us_{};  // by tick modulo its size
  std::int64_t due_tick_ = 0;                    // the newest of these
  int parted_ = 0;
};

}  // namespace seam
