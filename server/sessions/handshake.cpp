#include "server/sessions/handshake.h"

#include <algorithm>
#include <utility>

#include "common/codec/codec.h"
#include "common/net/datagram.h"
#include "common/net/link.h"
#include "common/net/loose_datagram.h"

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
  const MessageType* const type = FindType(bytes);
  return type != nullptr &&
         (type->name == std::string("hello_t") || type->name == std::string("join_t"));
}

}  // namespace

Handshake::Verdict Handshake::Receive(std::int64_t now_us, const Address& from,
                                      std::uint64_t number, ByteView datagram,
                                      JoinRequest* request) {
  const ByteView message = LooseMessage(datagram);
  if (!BeginsAsHandshake(message)) return Verdict::kForeign;
  const AnyMessage any = Decode(message);
  if (const auto* hello = std::get_if<Hello>(&any)) {
    if (hello->protocol == kProtocolVersion) {
      Challenge(now_us, from, number, datagram.size);
    } else {
      Refuse(now_us, from, number, datagram.size, OtherProtocol(hello->protocol), false);
    }
    return Verdict::kAnswered;
  }
  const auto* join = std::get_if<Join>(&any);
  if (join == nullptr) return Verdict::kForeign;
  return OnJoin(now_us, from, number, datagram.size, *join, request);
}

Handshake::Verdict Handshake::OnJoin(std::int64_t now_us, const Address& from, std::uint64_t number,
                                     std::size_t sent_bytes, const Join& join,
                                     JoinRequest* request) {
  const std::int64_t slot = token_.SlotOf(now_us, from, number, join.token);
  const KeyPair* const ephemeral = slot < 0 ? nullptr : slot_keys_.Find(slot);
  if (ephemeral == nullptr) {
    // The token is too old, or another server's: send a new one.
    Challenge(now_us, from, number, sent_bytes);
    return Verdict::kAnswered;
  }
  if (join.protocol != kProtocolVersion) {
    Refuse(now_us, from, number, sent_bytes, OtherProtocol(join.protocol), true);
    return Verdict::kAnswered;
  }
  request->tag = UsedOnce::TagOf(join.exchange.data());
  const auto redirected = redirects_.find(request->tag);
  if (redirected != redirects_.end()) Send(from, redirected->second.datagram);
  if (used_.Has(request->tag) || !MayCompute(now_us)) return Verdict::kAnswered;
  TokenGrant grant;
  const std::string refusal = ReadPass(now_us, join, request, &grant);
  if (!refusal.empty()) {
    Refuse(now_us, from, number, sent_bytes, refusal, true);
    return Verdict::kAnswered;
  }
  JoinTerms terms;
  terms.protocol = static_cast<std::uint32_t>(kProtocolVersion);
  terms.number = number;
  terms.cookie = join.token;
  terms.name = join.name;
  terms.room = join.room;
  std::copy_n(join.exchange.begin(), terms.client.size(), terms.client.begin());
  terms.ephemeral = ephemeral->open;
  terms.identity = identity_.open;
  terms.pass = join.grant;
  terms.epoch = join.epoch;
  terms.proof = join.proof;
  SealedKey sealed{};
  std::copy_n(join.exchange.begin() + static_cast<std::ptrdiff_t>(terms.client.size()),
              sealed.size(), sealed.begin());
  const auto secrets = JoinSecrets::OfServer(terms, ephemeral->secret, identity_.secret,
                                             request->token ? &grant.keys : nullptr);
  const auto key = secrets ? secrets->OpenKey(sealed) : std::nullopt;
  if (!key) {
    // Changed on the way, or made for keys that somebody else has sent: say ours again.
    Challenge(now_us, from, number, sent_bytes);
    return Verdict::kAnswered;
  }
  request->name = join.name;
  if (!request->token) request->room = join.room;
  request->epoch = join.epoch;
  // Where there are several rooms, or none, the proof is of the one that is asked for.
  const std::string& room = door_.room.empty() ? join.room : door_.room;
  request->epoch_proved =
      join.epoch > 0 && join.proof == EpochProof(identity_.secret, room, join.epoch);
  request->place_key = *key;
  request->keys = secrets->keys();
  return Verdict::kJoins;
}

void Handshake::NoteGranted(std::int64_t now_us, const JoinRequest& request) {
  used_.Note(now_us, request.tag, now_us + 2 * AddressToken::kSlotUs);
  if (request.token) used_.Note(now_us, request.token_tag, request.token_until_us);
}

void Handshake::AnswerByRedirect(std::int64_t now_us, const Address& to, const JoinRequest& request,
                                 Redirect redirect) {
  for (auto sent = redirects_.begin(); sent != redirects_.end();) {
    sent = sent->second.until_us <= now_us ? redirects_.erase(sent) : std::next(sent);
  }
  used_.Note(now_us, request.tag, now_us + 2 * AddressToken::kSlotUs);
  redirect.utime = now_us;
  Link link(request.keys);
  link.SendReliable(Encode(redirect));
  RedirectSent sent{{}, now_us + 2 * AddressToken::kSlotUs};
  link.Flush(now_us, [&](ByteView bytes) { sent.datagram.assign(bytes.begin(), bytes.end()); });
  Send(to, sent.datagram);
  redirects_[request.tag] = std::move(sent);
}

std::string Handshake::ReadPass(std::int64_t now_us, const Join& join, JoinRequest* request,
                                TokenGrant* grant) const {
  if (join.grant.empty()) return "";
  if (door_.key == nullptr) return "no tokens are taken here: join without --token";
  TokenNeed need;
  need.protocol = static_cast<std::uint32_t>(kProtocolVersion);
  // Where the rooms are others', each takes the tokens that are for it.
  need.room = door_.room.empty() ? join.room : door_.room;
  need.name = join.name;
  need.now_s = now_us / 1000000;
  const Status status = OpenPass(join.grant, *door_.key, need, grant);
  if (!status.ok()) return status.why();
  request->token_tag = UsedOnce::TagOf(TagOfPass(join.grant));
  if (used_.Has(request->token_tag)) return "the token was used before";
  request->token = true;
  request->room = grant->room;
  request->may_play = grant->may_play;
  // No token may be kept for longer than a day in the memory of used ones.
  const std::int64_t left_s = std::min<std::int64_t>(grant->expires_s - need.now_s, 86400);
  request->token_until_us = now_us + (left_s + 1) * 1000000;
  return "";
}

bool Handshake::MayCompute(std::int64_t now_us) {
  const double passed_s =
      filled_us_ < 0 ? 0
                     : static_cast<double>(std::max<std::int64_t>(0, now_us - filled_us_)) / 1e6;
  filled_us_ = now_us;
  joins_left_ = std::min(kJoinsAtOnce, joins_left_ + passed_s * kJoinsPerSecond);
  if (joins_left_ < 1) return false;
  joins_left_ -= 1;
  return true;
}

void Handshake::Challenge(std::int64_t now_us, const Address& to, std::uint64_t number,
                          std::size_t sent_bytes) {
  // No amplification: a shorter Hello is no client's of this protocol.
  if (sent_bytes < kHandshakeBytes) return;
  seam::Challenge challenge;
  challenge.utime = now_us;
  challenge.token = token_.Make(now_us, to, number);
  const PublicKey& ephemeral = slot_keys_.Draw(AddressToken::SlotAt(now_us)).open;
  challenge.keys.assign(ephemeral.begin(), ephemeral.end());
  challenge.keys.insert(challenge.keys.end(), identity_.open.begin(), identity_.open.end());
  Send(to, LooseDatagram(number, Encode(challenge)));
}

void Handshake::Refuse(std::int64_t now_us, const Address& to, std::uint64_t number,
                       std::size_t sent_bytes, const std::string& reason, bool proved) {
  Bye bye;
  bye.utime = now_us;
  bye.reason = reason;
  const Bytes datagram = LooseDatagram(number, Encode(bye));
  const std::size_t earned = proved ? sent_bytes : sent_bytes / 3;
  if (credit_.Draw(to, earned, datagram.size())) Send(to, datagram);
}

void Handshake::RefuseSession(std::int64_t now_us, const Address& to, ByteView datagram) {
  Refuse(now_us, to, SessionOfDatagram(datagram), datagram.size, "no such session", false);
}

void Handshake::Send(const Address& to, const Bytes& datagram) {
  bytes_ += static_cast<std::int64_t>(datagram.size());
  ++datagrams_;
  traffic_.AddLoose(datagram, true);
  net_.Send(to, datagram);
}

void Handshake::Count(Stats* stats) {
  stats->bytes_out += std::exchange(bytes_, 0);
  stats->datagrams_out += std::exchange(datagrams_, 0);
}

}  // namespace seam
