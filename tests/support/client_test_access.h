#pragma once
/// A client's own voice, to say with it what no client of ours would say.

#include "client/client.h"
#include "common/codec/codec.h"

namespace seam {

struct ClientTestAccess {
  /// Reliably, in its session, with its next Flush.
  template <class Message>
  static void Say(Client* client, const Message& message) {
    client->link_->SendReliable(Encode(message));
  }
  /// Reliable messages that wait to be acknowledged.
  static std::size_t Waiting(const Client& client) {
    return client.link_ == nullptr ? 0 : client.link_->waiting();
  }
};

}  // namespace seam
