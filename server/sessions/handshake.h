#pragma once
/// What the server says to those it has no session with. It builds and remembers nothing for them:
/// a Hello draws a Challenge, a Join is only passed on with the Challenge's token in it.

#include <cstdint>
#include <string>

#include "common/base/entropy.h"
#include "common/codec/messages.h"
#include "common/net/net.h"
#include "server/sessions/address_token.h"
#include "server/sessions/byte_credit.h"

namespace seam {

class Handshake {
 public:
  /// `net` must outlive it. Draws its secrets from `entropy`.
  Handshake(Net& net, Entropy& entropy) : net_(net), token_(entropy), credit_(entropy) {}

  enum class Verdict {
    kJoins,     ///< proved its address; `join` says as whom it wants to come in
    kAnswered,  ///< with a Challenge or a refusal, or not worth one
    kForeign,   ///< neither Hello nor Join
  };
  /// Looks at the first message of a datagram whose header was read: session `number`. Decodes it
  /// if it is a Hello or a Join.
  Verdict Receive(std::int64_t now_us, const Address& from, std::uint64_t number, ByteView datagram,
                  Join* join);

  /// Says why not, in answer to a datagram of `sent_bytes`, within the address's byte credit.
  void Refuse(std::int64_t now_us, const Address& to, std::uint64_t number, std::size_t sent_bytes,
              const std::string& reason);

  /// Adds what was sent since the last call.
  void Count(Stats* stats);

 private:
  void Challenge(std::int64_t now_us, const Address& to, std::uint64_t number);
  void Send(const Address& to, const Bytes& datagram);

  Net& net_;
  const AddressToken token_;
  ByteCredit credit_;
  std::int64_t bytes_ = 0, datagrams_ = 0;  // sent, not counted yet
};

}  // namespace seam
