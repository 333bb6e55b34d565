#pragma once
/// The watchers of a relay: joining, timeouts, leaving. To the room all of them are one peer, the
/// relay's, so that a message for it is a message for each of them.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "common/base/entropy.h"
#include "common/codec/codec.h"
#include "common/net/net.h"
#include "common/scene/scene.h"
#include "server/relay/watcher.h"
#include "server/sessions/handshake.h"
#include "server/sessions/room_chunks.h"

namespace seam {

struct WatcherLimits {
  int watchers = 0;        ///< most at a time
  double bytes_per_s = 0;  ///< most to each; 0: as much as its path carries
};

class WatcherTable {
 public:
  /// `net` and `entropy` must outlive this. `identity`: the relay's lasting keys, nullptr: drawn;
  /// `token_key`: the operator's, nullptr: anybody may watch.
  WatcherTable(Net& net, Entropy& entropy, const WatcherLimits& limits,
               std::shared_ptr<const KeyPair> identity, std::shared_ptr<const Secret> token_key);

  /// The room, as the relay has joined it.
  struct Joined {
    Room room;
    const Scene* scene = nullptr;  ///< only used in SetRoom
    int peer = 0;                  ///< the relay's
    std::int32_t epoch = 0;
  };
  /// Ends all sessions without a word: watchers find that they are not known here, and join anew.
  /// `play_at`: address at which players are sent to join.
  void SetRoom(const Joined& joined, const std::string& play_at);
  bool has_room() const { return chunks_ != nullptr; }

  using Deliver = std::function<void(Watcher&, ByteView)>;
  /// Takes the datagrams that have come; calls `deliver` for each message of a watcher.
  void ReceiveAll(std::int64_t now_us, const Deliver& deliver);
  /// Sends the room to those that were admitted, as fast as they acknowledge it. Calls `loaded` for
  /// each that was sent all of it, if `serves`: the world has to follow.
  void Advance(std::int64_t now_us, bool serves, const std::function<void(Watcher&)>& loaded);
  /// Drops watchers that are silent, never get ready, send too much, or are leaving.
  void DropSilent(std::int64_t now_us);
  /// Sends queued messages, to each watcher as fast as its path and budget allow.
  void Flush(std::int64_t now_us);
  /// True if the path to the watcher carries a datagram now.
  bool Carries(std::int64_t now_us, Watcher& watcher) const;
  /// Says goodbye to all.
  void Close(std::int64_t now_us, const std::string& reason);

  /// Sends reliably to every watcher that was sent the room.
  void SendToAll(const Bytes& message, bool urgent);
  void SendTo(Watcher& watcher, const Bytes& message);
  /// Calls `visit(Watcher&)` for each that is ready.
  template <class Visit>
  void EachReady(const Visit& visit) {
    for (auto& [id, watcher] : watchers_) {
      if (watcher->stage == SessionStage::kReady) visit(*watcher);
    }
  }
  /// Marks a watcher as ready; false unless it was loading. One that was not sent the world yet
  /// gets ready when it is.
  bool NoteReady(Watcher& watcher);
  int count() const { return static_cast<int>(watchers_.size()); }
  int ready() const { return ready_; }
  const PublicKey& identity() const { return identity_->open; }
  /// Bytes and datagrams of watchers and strangers, and those dropped, by reason.
  Stats& stats() { return stats_; }
  const Stats& stats() const { return stats_; }

 private:
  void Receive(std::int64_t now_us, const Address& from, const Bytes& datagram,
               const Deliver& deliver);
  void OnStranger(std::int64_t now_us, const SessionId& id, const Bytes& datagram);
  void OnWatcher(std::int64_t now_us, Watcher& watcher, const Address& from, const Bytes& datagram,
                 const Deliver& deliver);
  /// Returns why a client that has proved its address may not watch, or "".
  std::string NoEntry(const JoinRequest& join) const;
  void Admit(std::int64_t now_us, const SessionId& id, const JoinRequest& join);
  /// Returns the secret that lets this watcher join again without a token.
  std::uint64_t DrawKey();
  bool IsOver(std::int64_t now_us, const Watcher& watcher) const;
  void FlushTo(std::int64_t now_us, Watcher& watcher);
  void Clear();

  Net& net_;
  Entropy& entropy_;
  const WatcherLimits limits_;
  const std::shared_ptr<const KeyPair> identity_;
  const std::shared_ptr<const Secret> token_key_;
  TrafficCount traffic_;
  std::unique_ptr<Handshake> handshake_;  // nullptr before the first room
  std::unique_ptr<RoomChunks> chunks_;
  std::string room_;                         // its name
  std::unordered_set<std::string> players_;  // names of its scene
  Welcome welcome_;                          // but for the key
  Redirect redirect_;                        // for players
  TrafficRate allowed_;
  std::map<SessionId, std::unique_ptr<Watcher>> watchers_;
  std::unordered_map<std::uint64_t, Watcher*> by_number_;  // by the number of the sealed session
  int ready_ = 0;
  std::unordered_set<std::uint64_t> keys_;  // hashes of the keys of watchers with a token
  std::deque<std::uint64_t> keys_in_order_;
  std::int64_t look_us_ = 0;  // time of the next look for silent watchers
  Stats stats_;
};

}  // namespace seam
