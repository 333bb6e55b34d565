#pragma once
/// What everyone is told: numbered on the bus, and to the sessions that it concerns.

#include <cstdint>
#include <string>
#include <vector>

#include "common/sync/publisher.h"
#include "common/sync/replica.h"
#include "server/authority/authority_manager.h"
#include "server/sessions/session_table.h"

namespace seam {

class Broadcast {
 public:
  /// All must outlive it.
  Broadcast(Recorder& recorder, const std::string& room, const SyncConfig& config,
            const Replica& replica, const AuthorityManager& authority, SessionTable& sessions)
      : publisher_(recorder, room),
        config_(config),
        replica_(replica),
        authority_(authority),
        sessions_(sessions) {}

  /// On the bus only.
  template <class Message>
  void Publish(const Message& message) {
    publisher_.Publish(message);
  }
  /// On the bus and, reliably, to everyone who has proved its address.
  template <class Message>
  void ToAll(const Message& message) {
    publisher_.Publish(message);
    sessions_.SendToAll(Encode(message));
  }
  void ToAll(const std::vector<Grants>& messages) {
    for (const Grants& grants : messages) ToAll(grants);
  }
  /// To each of the other peers what it needs now: all of the bodies that it follows, the others at
  /// least kNearSends sends apart, and kFarSends what is far from all that it has. Not on the bus.
  void Relay(const States& states, int from_peer);
  /// Something a person wants to read; on the bus only.
  void Say(std::int64_t now_us, const std::string& text);

  static constexpr int kNearSends = 3, kFarSends = 15;

 private:
  /// The entries that the peer is to be told now.
  std::vector<std::size_t> Due(const States& states, Session* session) const;

  Publisher publisher_;
  const SyncConfig config_;
  const Replica& replica_;
  const AuthorityManager& authority_;
  SessionTable& sessions_;
};

}  // namespace seam
