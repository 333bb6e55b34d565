#pragma once
/// A client of a SessionTable: the player's half of the handshake and of the session, by hand.

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/codec/codec.h"
#include "common/net/datagram.h"
#include "common/net/link.h"
#include "common/net/memory.h"

namespace seam {

struct Guest {
  static constexpr Address kServer{1, 7777};

  /// Makes a guest at an address of its own; its session number is its port.
  Guest(MemoryNetwork* network, std::uint16_t port, const std::string& guest)
      : Guest(network->Attach({0x7f000001, port}), port, guest) {}
  Guest(std::unique_ptr<Net> endpoint, std::uint64_t session, const std::string& guest)
      : net(std::move(endpoint)), link(session), number(session), name(guest) {}

  void SendLoose(const Bytes& message) { net->Send(server, LooseDatagram(number, message)); }
  void SayHello(std::int32_t protocol = kProtocolVersion) {
    Hello hello;
    hello.name = name;
    hello.protocol = protocol;
    SendLoose(Encode(hello));
  }
  void SayJoin() {
    Join join;
    join.name = name;
    join.token = token.value_or(0);
    join.key = key;
    SendLoose(Encode(join));
  }
  /// Sends the queued messages of its link.
  void Flush(std::int64_t now_us) {
    link.Flush(now_us, [&](ByteView datagram) { net->Send(server, datagram); });
  }
  /// Reads the received datagrams for tokens, keys and refusals; the next Flush acknowledges them.
  void Read(std::int64_t now_us) {
    Address from;
    Bytes datagram;
    const auto take = [&](ByteView message) {
      const AnyMessage any = Decode(message);
      if (const auto* bye = std::get_if<Bye>(&any)) refusal = bye->reason;
      if (const auto* challenge = std::get_if<Challenge>(&any)) token = challenge->token;
      if (const auto* welcome = std::get_if<Welcome>(&any)) key = welcome->key, welcomed = true;
    };
    while (net->Receive(&from, &datagram)) {
      bytes_in += datagram.size();
      DatagramHeader header;
      if (!ReadHeader(datagram, &header) || header.session != number) continue;
      if (header.loose()) {
        take(FirstUnreliable(datagram));
      } else {
        link.Receive(now_us, datagram, take);
      }
    }
  }

  Address server = kServer;
  std::unique_ptr<Net> net;
  Link link;
  std::uint64_t number;
  std::string name;
  std::optional<std::int64_t> token;
  std::int64_t key = 0;
  bool welcomed = false;
  std::string refusal;
  std::size_t bytes_in = 0;
};

}  // namespace seam
