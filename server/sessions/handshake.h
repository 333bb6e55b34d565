#pragma once
/// Answers datagrams of senders without a session; keeps no session state for them. A Hello is
/// answered by a Challenge; a Join is passed on only with a valid token of a Challenge.

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
    kJoins,     ///< has proved its address; `join` is its request
    kAnswered,  ///< by a Challenge or a refusal, or not at all for lack of byte credit
    kForeign,   ///< neither Hello nor Join
  };
  /// Handles the first message of a datagram with a valid header (session `number`). Decodes the
  /// message only if it is a Hello or a Join.
  Verdict Receive(std::int64_t now_us, const Address& from, std::uint64_t number, ByteView datagram,
                  Join* join);

  /// Sends the reason of a refusal, in answer to a datagram of `sent_bytes`, if the address's byte
  /// credit allows.
  void Refuse(std::int64_t now_us, const Address& to, std::uint64_t number, std::size_t sent_bytes,
              const std::string& reason);

  /// Adds the bytes and datagrams sent since the last call to `stats`.
  void Count(Stats* stats);

 private:
  void Challenge(std::int64_t now_us, const Address& to, std::uint64_t number);
  void Send(const Address& to, const Bytes& datagram);

  Net& net_;
  const AddressToken token_;
  ByteCredit credit_;
  std::int64_t bytes_ = 0, datagrams_ = 0;  // sent since the last Count
};

}  // namespace seam
