#pragma once
/// A player's client of a real server, for other programs: over UDP and in real time.

#include <cstdint>
#include <memory>
#include <string>

#include "client/client.h"
#include "common/base/entropy.h"
#include "common/net/impair.h"
#include "common/net/udp.h"
#include "common/record/recording.h"
#include "common/record/sink.h"

namespace seam {

struct UdpClientConfig {
  std::string server;              ///< host:port
  std::string name;                ///< the player to be; "": a guest who looks on
  std::string room;                ///< "": the server's first
  std::string server_key;          ///< the server's public key in hex; "": whoever answers
  std::string impair = "perfect";  ///< network, both directions
  std::int64_t seed = 1;           ///< of the impairment
  std::string lcm_url = "none";    ///< bus for its views; "none": none
  std::string record;              ///< log to write; "": none
  bool force = false;              ///< replaces a log that is there
};

class UdpClient {
 public:
  /// Throws OperatorError when a name, address, key or profile is wrong, or the log cannot be
  /// written.
  explicit UdpClient(const UdpClientConfig& config);
  /// Leaves the room.
  ~UdpClient();
  UdpClient(const UdpClient&) = delete;
  UdpClient& operator=(const UdpClient&) = delete;

  /// Receives, steps the ticks that are due and sends; then waits for the next, at most 20 ms.
  /// Throws OperatorError when the server refuses it, or its log cannot be written.
  void Turn();
  /// Sets the input, held until the next call.
  void SetInput(const Input& input) { client_.SetLiveInput(input); }
  /// Returns the newest line of the server for this player, once; "": none.
  std::string TakeNotice() { return client_.TakeNotice(); }
  /// Says goodbye; Turn does nothing any more.
  void Leave();

  const Client& client() const { return client_; }
  /// True after Leave, and when the server has closed the room.
  bool ended() const { return left_ || client_.closed(); }
  /// Returns the tick of its world, -1 before the room runs.
  std::int64_t tick() const;
  /// Returns the bodies as it displays them now. Throws OperatorError before the room has come.
  View ViewNow() const;

 private:
  UdpNet udp_;
  ImpairedNet net_;
  Sink sink_;
  OsEntropy entropy_;
  Client client_;
  bool left_ = false;
};

}  // namespace seam
