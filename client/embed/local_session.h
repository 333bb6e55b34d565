#pragma once
/// A whole session for other programs, in one process and in virtual time: a server, a client for
/// each of the scene's players, and a simulated network. The same calls give the same bits.

#include <cstdint>
#include <memory>
#include <string>

#include "client/embed/cluster.h"
#include "common/record/recording.h"
#include "common/record/room_log.h"

namespace seam {

struct LocalSessionConfig {
  std::string mode = "buffer";   ///< as of seam-server --mode
  std::string reconcile;         ///< of mode buffer; "": its default
  std::string predict;           ///< of mode central; "": all
  std::string impair = "demo";   ///< network between server and clients
  std::int64_t seed = 1;         ///< of the network and of bots
  int send_hz = 30;              ///< States per second from each peer
  std::string drive = "inputs";  ///< inputs (SetInput) | script (the scene's) | bot
  std::string record;            ///< log to write; "": none
  bool force = false;            ///< replaces a log that is there
  bool keep = false;             ///< recording() has everything, which costs memory
};

class LocalSession {
 public:
  /// Throws OperatorError when a name is unknown, a number out of range, or the log cannot be
  /// written.
  LocalSession(const Scene& scene, const LocalSessionConfig& config);
  /// Ends the log, if there is one, as seam-server does.
  ~LocalSession();
  LocalSession(const LocalSession&) = delete;
  LocalSession& operator=(const LocalSession&) = delete;

  /// Runs until the server has done this many ticks; nothing if it has. Throws OperatorError if
  /// the players cannot join within 30 s of virtual time, or the log cannot be written.
  void RunToTick(std::int64_t tick);
  /// Sets a player's input, held until the next call, in a session that is driven by inputs. Throws
  /// OperatorError if there is no such player or the session is driven otherwise.
  void SetInput(int player, const Input& input);

  std::int64_t tick() const { return cluster_.server().tick(); }
  /// Returns the number of clients: that of the scene's players.
  int client_count() const { return cluster_.client_count(); }
  /// Returns the bodies as a peer displays them now; 0: the server, 1 .. client_count(): the client
  /// of the scene's first player and so on. Empty before a client has the room. Throws
  /// OperatorError if there is no such peer.
  View ViewOf(int peer) const;
  const Scene& scene() const { return cluster_.scene(); }
  const Server& server() const { return cluster_.server(); }
  /// Returns the client of a player, 0 .. client_count() - 1.
  const Client& client(int player) const { return *cluster_.client(player); }
  /// Returns all messages so far. Requires LocalSessionConfig::keep; else empty.
  const Recording& recording() { return cluster_.recording(); }
  /// Writes the log's last events. Throws OperatorError if the log cannot be written.
  void Flush();

 private:
  void RequireLog() const;

  const Drive drive_;
  std::unique_ptr<RoomLog> log_;  // nullptr: none
  Cluster cluster_;
};

}  // namespace seam
