#pragma once
/// Somebody on the path between a client and its server from the beginning, whom the client takes
/// for the server: it has joined without --server-key. Opens each datagram, and seals it again for
/// the other end, changed or not. Sequence numbers stay.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/codec/codec.h"
#include "common/codec/short_form.h"
#include "common/net/datagram.h"
#include "common/net/key_exchange.h"
#include "common/net/loose_datagram.h"
#include "common/net/sequence_window.h"

namespace seam {

class Middle {
 public:
  /// May change the header and the messages of a datagram. False: the datagram is lost.
  using Change = std::function<bool(DatagramHeader* header, std::vector<Bytes>* messages)>;

  explicit Middle(std::uint64_t seed = 4711)
      : entropy_(seed), ephemeral_(entropy_), identity_(entropy_) {}

  /// Returns what goes on to the server; what is of no session of ours, as it is.
  std::optional<Bytes> Up(ByteView datagram, const Change& change) {
    if (SessionOfDatagram(datagram) == 0) return LooseUp(datagram);
    const auto leg = by_client_.find(SessionOfDatagram(datagram));
    if (leg == by_client_.end()) return Bytes(datagram.begin(), datagram.end());
    Leg& l = *leg->second;
    return Pass(datagram, l.to_client, l.to_server, &l.newest_up, change);
  }
  /// Returns what goes on to the client.
  std::optional<Bytes> Down(ByteView datagram, const Change& change) {
    if (SessionOfDatagram(datagram) == 0) return LooseDown(datagram);
    const auto leg = by_server_.find(SessionOfDatagram(datagram));
    if (leg == by_server_.end()) return Bytes(datagram.begin(), datagram.end());
    Leg& l = *leg->second;
    return Pass(datagram, l.to_server, l.to_client, &l.newest_down, change);
  }

 private:
  /// A session: the seals of the two that we have instead of one.
  struct Leg {
    Seal to_client, to_server;
    std::int64_t newest_up = 0, newest_down = 0;
  };

  static std::optional<Bytes> Pass(ByteView datagram, const Seal& from, const Seal& to,
                                   std::int64_t* newest, const Change& change) {
    const std::int64_t number = Unwrap(SequenceOfDatagram(datagram), *newest);
    Bytes plain;
    DatagramHeader header;
    std::vector<DatagramMessage> read;
    if (!OpenDatagram(datagram, from, number, &plain, &header) || !ReadMessages(plain, &read)) {
      return Bytes(datagram.begin(), datagram.end());
    }
    *newest = std::max(*newest, number);
    std::vector<Bytes> messages;
    for (const DatagramMessage& m : read) {
      messages.emplace_back();
      if (!ReadShortForm(m.bytes, &messages.back())) return Bytes(datagram.begin(), datagram.end());
    }
    if (change && !change(&header, &messages)) return std::nullopt;
    DatagramWriter writer;
    for (std::size_t i = 0; i < read.size(); ++i) {
      messages[i] = ShortForm(messages[i]);
      read[i].bytes = messages[i];
      writer.Append(read[i]);
    }
    return writer.Finish(header, to);
  }

  std::optional<Bytes> LooseDown(ByteView datagram) {
    const std::uint64_t number = LooseNumber(datagram);
    const AnyMessage any = number == 0 ? AnyMessage() : Decode(LooseMessage(datagram));
    const auto* theirs = std::get_if<Challenge>(&any);
    if (theirs == nullptr) return Bytes(datagram.begin(), datagram.end());
    challenges_[theirs->token] = *theirs;
    Challenge ours = *theirs;
    ours.keys.assign(ephemeral_.open.begin(), ephemeral_.open.end());
    ours.keys.insert(ours.keys.end(), identity_.open.begin(), identity_.open.end());
    return LooseDatagram(number, Encode(ours));
  }

  std::optional<Bytes> LooseUp(ByteView datagram) {
    const std::uint64_t number = LooseNumber(datagram);
    const AnyMessage any = number == 0 ? AnyMessage() : Decode(LooseMessage(datagram));
    const auto* join = std::get_if<Join>(&any);
    const auto challenge = join == nullptr ? challenges_.end() : challenges_.find(join->token);
    if (challenge == challenges_.end()) return Bytes(datagram.begin(), datagram.end());
    JoinTerms terms;
    terms.protocol = static_cast<std::uint32_t>(join->protocol);
    terms.number = number;
    terms.cookie = join->token;
    terms.name = join->name;
    terms.room = join->room;
    terms.pass = join->grant;
    terms.epoch = join->epoch;
    terms.proof = join->proof;
    SealedKey sealed{};
    const auto half = join->exchange.begin() + static_cast<std::ptrdiff_t>(terms.client.size());
    std::copy(join->exchange.begin(), half, terms.client.begin());
    std::copy(half, join->exchange.end(), sealed.begin());
    terms.ephemeral = ephemeral_.open;
    terms.identity = identity_.open;
    const auto hers = JoinSecrets::OfServer(terms, ephemeral_.secret, identity_.secret, nullptr);
    const auto key = hers ? hers->OpenKey(sealed) : std::nullopt;
    if (!key) return Bytes(datagram.begin(), datagram.end());
    const KeyPair& client = clients_.try_emplace(terms.client, entropy_).first->second;
    terms.client = client.open;
    const auto& keys = challenge->second.keys;
    std::copy_n(keys.begin(), 32, terms.ephemeral.begin());
    std::copy_n(keys.begin() + 32, 32, terms.identity.begin());
    const auto its = JoinSecrets::OfClient(terms, client.secret, nullptr);
    const auto leg = std::make_shared<Leg>(Leg{Seal(hers->keys()), Seal(its->keys())});
    by_client_.emplace(hers->keys().session, leg);
    by_server_.emplace(its->keys().session, leg);
    Join ours = *join;
    ours.exchange.assign(client.open.begin(), client.open.end());
    const SealedKey again = its->CloseKey(*key);
    ours.exchange.insert(ours.exchange.end(), again.begin(), again.end());
    return LooseDatagram(number, Encode(ours), kHandshakeBytes);
  }

  SeededEntropy entropy_;
  const KeyPair ephemeral_, identity_;
  std::map<std::int64_t, Challenge> challenges_;  // the server's, by token
  std::map<PublicKey, KeyPair> clients_;          // our own, by the client's
  std::map<std::uint64_t, std::shared_ptr<Leg>> by_client_, by_server_;
};

}  // namespace seam
