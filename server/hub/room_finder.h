#pragma once
/// Finds the room of a datagram: by its session, or for a Join by the room it names. Remembers only
/// sessions that a room has admitted. Learn and count are thread-safe.

#include <cstdint>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/net/net.h"

namespace seam {

class RoomFinder {
 public:
  /// `rooms`: names, each once.
  explicit RoomFinder(std::vector<std::string> rooms) : rooms_(std::move(rooms)) {}

  /// The datagram belongs to no session and asks for no room.
  static constexpr int kNone = -1;
  /// It asks for a room that does not exist here; see Refusal.
  static constexpr int kUnknown = -2;
  /// It is a Hello, which names no room. A Challenge as answer makes the client send a Join, and
  /// the room that the Join names sends its own Challenge.
  static constexpr int kHello = -3;
  /// Returns the index of the room, or one of the above. With a single room, everything goes to it
  /// except a Join to another room.
  int Find(std::int64_t now_us, ByteView datagram);
  /// Adds a room and returns its index; one of the same name is not asked for any more.
  int Add(const std::string& room);
  /// Returns the refusal for a client that asked for an unknown room.
  std::string Refusal() const;

  /// Records that a room sends in a session: from now on datagrams of that session go to the room,
  /// from whatever address.
  void Learn(std::int64_t now_us, int room, std::uint64_t session);
  /// Number of remembered sessions.
  std::size_t count() const;

  /// A session without a datagram for so long is forgotten, us: its room has dropped it long
  /// before.
  static constexpr std::int64_t kKeepUs = 30000000;

 private:
  struct Route {
    int room = 0;
    std::int64_t heard_us = 0;
  };
  int Asked(ByteView datagram) const;
  void ForgetOld(std::int64_t now_us);

  std::vector<std::string> rooms_;  // of the hub's thread; "": asked for no more
  mutable std::mutex mutex_;
  std::unordered_map<std::uint64_t, Route> routes_;  // by session, which nobody can choose
  std::int64_t swept_us_ = 0;
};

}  // namespace seam
