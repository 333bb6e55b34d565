#pragma once
/// A client of a SessionTable: the player's half of the handshake and of the session, by hand.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "client/join_offers.h"
#include "common/codec/codec.h"
#include "common/net/datagram.h"
#include "common/net/link.h"
#include "common/net/loose_datagram.h"
#include "common/net/memory.h"
#include "tests/support/path/link_keys.h"

namespace seam {

struct Guest {
  static constexpr Address kServer{1, 7777};

  /// Makes a guest at an address of its own; its session number is its port.
  Guest(MemoryNetwork* network, std::uint16_t port, const std::string& guest)
      : Guest(network->Attach({0x7f000001, port}), port, guest) {}
  Guest(std::unique_ptr<Net> endpoint, std::uint64_t session, const std::string& guest)
      : net(std::move(endpoint)),
        link(LinkKeys(session)),
        number(session),
        name(guest),
        entropy(session) {}

  void SendLoose(const Bytes& message) {
    net->Send(server, LooseDatagram(number, message, kHandshakeBytes));
  }
  void SayHello(std::int32_t protocol = kProtocolVersion) {
    Hello hello;
    hello.name = name;
    hello.protocol = protocol;
    SendLoose(Encode(hello));
  }
  void SayJoin() {
    const auto now = std::make_tuple(number, name, token);
    if (begun != now) offers.Begin(entropy, number, name, "", token);
    begun = now;
    Challenge none;
    none.keys.assign(kChallengeKeysBytes, 9);
    (void)offers.Take(challenge.value_or(none));
    SendLoose(Encode(offers.Make(0, key)));
  }
  /// Sends the queued messages of its link.
  void Flush(std::int64_t now_us) {
    link.Flush(now_us, [&](ByteView datagram) { net->Send(server, datagram); });
  }
  /// Reads the received datagrams for challenges, keys and refusals; the next Flush acknowledges
  /// them. `also` gets each message.
  void Read(
      std::int64_t now_us, const std::function<void(const AnyMessage&)>& also = [](auto&) {}) {
    Address from;
    Bytes datagram;
    const auto take = [&](ByteView message) {
      const AnyMessage any = Decode(message);
      if (const auto* bye = std::get_if<Bye>(&any)) refusal = bye->reason;
      if (const auto* come = std::get_if<Challenge>(&any)) challenge = *come;
      if (const auto* welcome = std::get_if<Welcome>(&any)) key = welcome->key, welcomed = true;
      also(any);
    };
    while (net->Receive(&from, &datagram)) {
      bytes_in += datagram.size();
      if (LooseNumber(datagram) == number) take(LooseMessage(datagram));
      PublicKey identity{};
      const std::uint64_t session = SessionOfDatagram(datagram);
      const SealKeys* const keys = session == 0 ? nullptr : offers.Find(session, &identity);
      if (keys != nullptr && link.session() != session) link = Link(*keys);
      if (link.session() == session) link.Receive(now_us, datagram, take);
    }
  }

  Address server = kServer;
  std::unique_ptr<Net> net;
  Link link;  // before it is welcomed: one that leads nowhere
  std::uint64_t number;
  std::string name;
  SeededEntropy entropy;
  JoinOffers offers;
  const ConnectToken* token = nullptr;  // to be shown
  std::tuple<std::uint64_t, std::string, const ConnectToken*> begun;
  std::optional<Challenge> challenge;
  std::int64_t key = 0;
  bool welcomed = false;
  std::string refusal;
  std::size_t bytes_in = 0;
};

}  // namespace seam
