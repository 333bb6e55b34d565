#include "server/sessions/handshake.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/net/datagram.h"

namespace seam {
namespace {

/// "protocol 5 is spoken here, you speak 4". Clients of other versions read the first number.
std::string OtherProtocol(std::int32_t theirs) {
  return "protocol " + std::to_string(kProtocolVersion) + " is spoken here, you speak " +
         std::to_string(theirs);
}

/// True if the bytes begin with the type of a Hello or a Join. Nothing else is decoded for a sender
/// without a session.
bool BeginsAsHandshake(ByteView bytes) {
  if (bytes.size < 8) return false;
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < 8; ++i) hash = hash << 8 | bytes.data[i];
  static const auto hash_of = [](const std::string& name) {
    const auto& types = MessageTypes();
    const auto found = std::find_if(types.begin(), types.end(),
                                    [&](const MessageType& type) { return type.name == name; });
    SEAM_ASSERT(found != types.end());
    return found->hash;
  };
  static const std::uint64_t hello = hash_of("hello_t"), join = hash_of("join_t");
  return hash == hello || hash == join;
}

}  // namespace

Handshake::Verdict Handshake::Receive(std::int64_t now_us, const Address& from,
                                      std::uint64_t number, ByteView datagram, Join* join) {
  const ByteView message = FirstUnreliable(datagram);
  if (!BeginsAsHandshake(message)) return Verdict::kForeign;
  const AnyMessage any = Decode(message);
  if (const auto* hello = std::get_if<Hello>(&any)) {
    if (hello->protocol == kProtocolVersion) {
      Challenge(now_us, from, number);
    } else {
      Refuse(now_us, from, number, datagram.size, OtherProtocol(hello->protocol));
    }
    return Verdict::kAnswered;
  }
  const auto* wish = std::get_if<Join>(&any);
  if (wish == nullptr) return Verdict::kForeign;
  if (!token_.Good(now_us, from, number, wish->token)) {
    // The token is too old, or another server's: send a new one.
    Challenge(now_us, from, number);
    return Verdict::kAnswered;
  }
  if (wish->protocol != kProtocolVersion) {
    Refuse(now_us, from, number, datagram.size, OtherProtocol(wish->protocol));
    return Verdict::kAnswered;
  }
  *join = *wish;
  return Verdict::kJoins;
}

void Handshake::Challenge(std::int64_t now_us, const Address& to, std::uint64_t number) {
  seam::Challenge challenge;
  challenge.utime = now_us;
  challenge.token = token_.Make(now_us, to, number);
  // Shorter than any Hello or Join, so no amplification; it needs no byte credit (tests/server).
  Send(to, LooseDatagram(number, Encode(challenge)));
}

void Handshake::Refuse(std::int64_t now_us, const Address& to, std::uint64_t number,
                       std::size_t sent_bytes, const std::string& reason) {
  Bye bye;
  bye.utime = now_us;
  bye.reason = reason;
  const Bytes datagram = LooseDatagram(number, Encode(bye));
  if (credit_.Draw(to, sent_bytes, datagram.size())) Send(to, datagram);
}

void Handshake::Send(const Address& to, const Bytes& datagram) {
  bytes_ += static_cast<std::int64_t>(datagram.size());
  ++datagrams_;
  net_.Send(to, datagram);
}

void Handshake::Count(Stats* stats) {
  stats->bytes_out += std::exchange(bytes_, 0);
  stats->datagrams_out += std::exchange(datagrams_, 0);
}

}  // namespace seam
