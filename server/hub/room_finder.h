#pragma once
/// Which room a datagram is for: by its session, and before there is one by the name in its Join.
/// It remembers only sessions that a room has admitted. For any thread.

#include <cstdint>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/net/net.h"

namespace seam {

class RoomFinder {
 public:
  /// Names of the rooms, each once.
  explicit RoomFinder(std::vector<std::string> rooms) : rooms_(std::move(rooms)) {}

  /// The datagram is of no session and asks for no room.
  static constexpr int kNone = -1;
  /// It asks for a room that is not here; see Refusal.
  static constexpr int kUnknown = -2;
  /// It is a Hello, which names no room: whoever answers it with a Challenge draws a Join, and the
  /// room that the Join names makes a Challenge of its own.
  static constexpr int kHello = -3;
  /// Index of the room, or one of the above. With a single room everything is for it, but a Join to
  /// another.
  int Find(std::int64_t now_us, const Address& from, ByteView datagram);
  /// A line for who asked for an unknown room.
  std::string Refusal() const;

  /// Room `room` sends within a session: what comes from there in it is for that room from now on.
  void Learn(std::int64_t now_us, int room, const Address& to, std::uint64_t session);
  /// Sessions that can still be found.
  std::size_t count() const;

  /// A session that nothing has come of for so long is forgotten, us: its room has dropped it long
  /// before.
  static constexpr std::int64_t kKeepUs = 30000000;

 private:
  struct Key {
    Address address;
    std::uint64_t session = 0;
    bool operator==(const Key& o) const { return session == o.session && address == o.address; }
  };
  struct Hash {  // sessions are random, and only of who was admitted
    std::size_t operator()(const Key& key) const {
      return static_cast<std::size_t>(key.session ^ key.address.ip ^ key.address.port);
    }
  };
  struct Route {
    int room = 0;
    std::int64_t heard_us = 0;
  };
  int Asked(ByteView datagram) const;
  void ForgetOld(std::int64_t now_us);

  const std::vector<std::string> rooms_;
  mutable std::mutex mutex_;
  std::unordered_map<Key, Route, Hash> routes_;
  std::int64_t swept_us_ = 0;
};

}  // namespace seam
