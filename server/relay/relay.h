#pragma once
/// Passes a room on to watchers: a watching client of a server, and a server of watchers. The
/// server has one more client, however many watch behind it. A function of the time and the
/// datagrams that it is given: it runs over UDP and in virtual time.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/client.h"
#include "client/client_tap.h"
#include "common/base/entropy.h"
#include "common/net/net.h"
#include "common/record/recorder.h"
#include "server/relay/relayed_edits.h"
#include "server/relay/shared_states.h"
#include "server/relay/watcher_table.h"

namespace seam {

struct RelayConfig {
  ClientConfig upstream;  ///< server, room, name, token; the rest is the relay's own
  WatcherLimits limits;
  std::string
      play_at;  ///< address at which players are sent to join; "": the server that it watches
  /// The relay's lasting keys; nullptr: drawn from its entropy.
  std::shared_ptr<const KeyPair> identity;
  /// The operator's key: each watcher has to show a connect token made with it. nullptr: anybody
  /// may watch. With it the clock of Tick has to be the time since 1970.
  std::shared_ptr<const Secret> token_key;
};

class Relay : private ClientTap {
 public:
  /// `upstream` leads to the server, `downstream` to the watchers; all must outlive the relay.
  Relay(const RelayConfig& config, Net& upstream, Net& downstream, Entropy& entropy);
  ~Relay() override = default;
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  /// Receives from both sides, follows the room, sends. `now_us`: any clock that never runs
  /// backwards.
  void Tick(std::int64_t now_us);
  /// Returns the latest time for the next call of Tick, on the same clock.
  std::int64_t next_tick_us(std::int64_t now_us) { return client_.next_tick_us(now_us); }
  /// Says goodbye to server and watchers; call Tick no more.
  void Shutdown(std::int64_t now_us, const std::string& reason);
  /// Goes to where the room is by the fleet's directory; see Client::Suggest.
  void Suggest(const Address& server, std::int32_t epoch) { client_.Suggest(server, epoch); }
  void SuggestStandby(const std::optional<Address>& standby) { client_.SuggestStandby(standby); }

  /// Returns the reason if the server refused the relay, or has a room that it cannot pass on; else
  /// "". Final.
  const std::string& fatal() const { return refusal_.empty() ? client_.fatal() : refusal_; }
  /// True if the server closed the room. Final as well.
  bool closed() const { return client_.closed(); }
  const Client& client() const { return client_; }
  std::int64_t joining_us(std::int64_t now_us) const { return client_.joining_us(now_us); }
  const WatcherTable& watchers() const { return watchers_; }
  /// Messages of states that were composed for all watchers, and again for one that had lost some.
  std::int64_t composed() const { return composed_; }
  std::int64_t composed_again() const { return composed_again_; }

 private:
  /// The relay puts nothing on the bus: its watchers do.
  class Silent : public Recorder {
   public:
    void Publish(const std::string&, std::int64_t, ByteView) override {}
    bool listening() const override { return false; }
  };

  void OnRoom() override;
  void OnMessage(const AnyMessage& message, ByteView bytes) override;
  void OnStates(const States& states) override;

  ClientConfig Upstream(const ClientConfig& config);
  /// True if a watcher can be sent the world now.
  bool Serves(std::int64_t now_us);
  void Deliver(std::int64_t now_us, Watcher& watcher, ByteView bytes);
  void OnPing(std::int64_t now_us, Watcher& watcher, const Ping& ping);
  void OnHello(std::int64_t now_us, Watcher& watcher);
  /// Compares the block of resting bodies in a ping; sends it again if the watcher has lost it.
  void LookAtRest(std::int64_t now_us, Watcher& watcher, const Ping& ping, Pong* pong);
  /// Sends edits, grants, states and values: all that a watcher needs to rebuild the world.
  void SendWorld(std::int64_t now_us, Watcher& watcher);
  void SendBodies(std::int64_t now_us, Watcher& watcher);
  bool StatesDue(std::int64_t now_us) const;
  /// Sends the states that have come since the last call, composed once for all.
  void SendStates(std::int64_t now_us);
  void SendStatesTo(std::int64_t now_us, const std::vector<SharedStates::Message>& messages,
                    Watcher& watcher);
  void SendInputs();
  void TellQuiet();
  /// Returns the address at which players join.
  std::string PlayAt() const;

  const std::string play_at_;
  Silent silent_;
  WatcherTable watchers_;
  std::optional<SharedStates> states_;      // once there is a room
  std::optional<RelayedEdits> edits_;       // likewise
  std::shared_ptr<const Scene> scene_;      // of edits_
  std::vector<std::int64_t> inputs_told_;   // by player: the newest tick sent
  std::vector<std::int64_t> inputs_until_;  // by player: last tick in which they are repeated
  std::int64_t states_sent_us_ = 0;
  std::string refusal_;
  std::int64_t composed_ = 0, composed_again_ = 0;
  Net& downstream_;
  Client client_;
};

}  // namespace seam
