#pragma once
/// Sends messages in a client's name that no honest client would send.

#include "client/client.h"
#include "common/codec/codec.h"

namespace seam {

struct ClientTestAccess {
  /// Sends a message reliably in the client's session, with its next Flush.
  template <class Message>
  static void Say(Client* client, const Message& message) {
    client->link_->SendReliable(Encode(message));
  }
  /// Number of reliable messages not yet acknowledged.
  static std::size_t Waiting(const Client& client) {
    return client.link_ == nullptr ? 0 : client.link_->waiting();
  }
};

}  // namespace seam
