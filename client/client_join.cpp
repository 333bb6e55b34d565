/// Client, joining: Hello, Challenge, Join, Welcome. See docs/protocol.md, "Joining".

#include <algorithm>
#include <cstdio>
#include <utility>
#include <variant>

#include "client/client.h"
#include "client/goodbye.h"
#include "common/base/hex.h"
#include "common/base/nearest.h"
#include "common/net/datagram.h"
#include "common/net/loose_datagram.h"

namespace seam {
namespace {

/// An unanswered Hello or Join is repeated after this, us.
constexpr std::int64_t kHelloUs = 100000;
/// A refused join is repeated for this long, us.
constexpr std::int64_t kInsistUs = 3000000;
/// The same of a server to which we were sent on: it may have to load the room first, us.
constexpr std::int64_t kInsistMovingUs = 10000000;

/// Time for the server to answer which names are free, us; older servers never do.
constexpr std::int64_t kNamesUs = 1000000;

/// Returns a line with both versions if `reason` says that the server speaks another protocol; else
/// "".
std::string OtherProtocol(const std::string& reason) {
  int theirs = 0, end = 0;
  const bool says =
      std::sscanf(reason.c_str(), "protocol %9d is spoken here%n", &theirs, &end) == 1 && end > 0;
  if (!says || theirs == kProtocolVersion) return "";
  return "the server speaks protocol " + std::to_string(theirs) + ", this client speaks " +
         std::to_string(kProtocolVersion) + ": they need the same version";
}

/// Returns the line for a client that only looks on and was given a player's place.
std::string PlayersPlace(const std::string& name) {
  return name +
         " is a player of this room: to look on, take another name, or a token made with "
         "--watch";
}

}  // namespace

void Client::Join(std::int64_t now_us) {
  Forget(now_us);
  BeginJoin(now_us);
}

void Client::Forget(std::int64_t now_us) {
  PublishUnmoved();
  link_.reset();
  unpacker_.reset();
  packer_.reset();
  unsent_.clear();
  replica_.reset();
  scene_.reset();
  snapshot_.reset();
  held_.Clear();
  world_bytes_.clear();
  world_given_ = false;
  room_bytes_.clear();
  room_size_ = 0;
  clock_ = ClockFilter();
  feed_ = InputFeed();
  metadata_ = MetaTable();
  settings_.Clear();
  if ((peer_ >= 0 && !moving_) || joining_since_us_ == 0) joining_since_us_ = now_us;
  peer_ = player_ = -1;
  said_ready_ = started_ = released_ = loaded_now_ = moving_ = false;
  knocks_at_.reset();
  told_standby_.reset();
  timeline_ = RoomTimeline();
  lead_us_ = lag_us_ = -1;
  answered_us_ = now_us;
  asked_names_us_ = -1;
}

void Client::BeginJoin(std::int64_t now_us) {
  do {
    number_ = entropy_.Next();
  } while (number_ == 0);
  BeginOffers();
  offer_fresh_ = false;
  next_.reset();
  refused_us_ = -1;
  why_refused_.clear();
  begun_us_ = now_us;
}

void Client::BeginOffers() {
  // A token counts once; who was in the room comes back with the key of the place.
  const bool shows = config_.token && !key_of_;
  // A server without the room has to know which one we mean.
  const std::string& room = knocks_at_ ? room_.room : config_.room;
  offers_.Begin(entropy_, number_, config_.name, room, shows ? &*config_.token : nullptr,
                proved_epoch_, proof_);
}

void Client::SendHelloOrJoin(std::int64_t now_us) {
  if (now_us - last_hello_us_ < kHelloUs && !offer_fresh_) return;
  last_hello_us_ = now_us;
  offer_fresh_ = false;
  if (offers_.empty()) {
    Hello hello;
    hello.utime = now_us;
    hello.name = config_.name;
    SendLoose(Encode(hello));
    return;
  }
  // Another server than the one that gave us the key has no use for it.
  const bool theirs = !key_of_ || SameKey(*key_of_, offers_.identity());
  SendLoose(Encode(offers_.Make(now_us, theirs ? key_ : 0)));
}

void Client::SendLoose(const Bytes& message) {
  const Bytes datagram = LooseDatagram(number_, message, kHandshakeBytes);
  stats_.bytes_out += static_cast<std::int64_t>(datagram.size());
  stats_.datagrams_out += 1;
  net_.Send(knocks_at_.value_or(config_.server), datagram);
}

void Client::OnUnknownSession(std::int64_t now_us) {
  // Anybody on the path can say so: our session goes on as long as it is answered.
  if (!moving_ && PongOverdue(now_us)) Join(now_us);
}

bool Client::OnHandshake(std::int64_t now_us, const Bytes& datagram) {
  const std::uint64_t number = LooseNumber(datagram);
  if (number != 0 && link_ != nullptr && number == link_->session()) {
    if (std::holds_alternative<Bye>(Decode(LooseMessage(datagram)))) OnUnknownSession(now_us);
    return true;
  }
  if (number_ == 0 || number != number_) return false;
  // Once we have joined, such a datagram is a late answer, or somebody else's.
  if (peer_ >= 0 && !moving_ && !knocks_at_) return true;
  const AnyMessage any = Decode(LooseMessage(datagram));
  if (const auto* challenge = std::get_if<Challenge>(&any)) {
    OnChallenge(now_us, *challenge);
  } else if (const auto* bye = std::get_if<Bye>(&any)) {
    OnRefusal(now_us, bye->reason);
  }
  return true;
}

void Client::OnChallenge(std::int64_t now_us, const Challenge& challenge) {
  const std::uint8_t* const identity = challenge.keys.data() + challenge.keys.size() / 2;
  PublicKey theirs{};
  std::copy_n(identity, theirs.size(), theirs.begin());
  // Only servers with the same lasting key know our place.
  if (knocks_at_ && !SameKey(*key_of_, theirs)) return;
  if (config_.server_key && !SameKey(*config_.server_key, theirs)) {
    return OnRefusal(now_us, "it has the key " + ToHex(theirs.data(), theirs.size()) +
                                 ", which is not the one of --server-key");
  }
  offer_fresh_ = offers_.Take(challenge) || offer_fresh_;
}

bool Client::OnSealed(std::int64_t now_us, const Bytes& datagram) {
  const std::uint64_t session = SessionOfDatagram(datagram);
  Link* link = link_ != nullptr && link_->session() == session ? link_.get() : nullptr;
  if (link == nullptr) {
    if (peer_ >= 0 && !moving_ && !knocks_at_) return false;  // a late answer to an earlier join
    PublicKey identity{};
    const SealKeys* const keys = offers_.Find(session, &identity);
    if (keys == nullptr) return false;
    if (next_ == nullptr || next_->session() != session) next_ = std::make_unique<Link>(*keys);
    next_of_ = identity;
    link = next_.get();
  }
  const bool good = link->Receive(now_us, datagram, [&](ByteView message) {
    if (link == link_.get()) {
      OnMessage(now_us, message);
    } else {
      OnOffered(now_us, message);
    }
  });
  if (redirect_) Follow(now_us, *std::exchange(redirect_, std::nullopt));
  if (!refusal_.empty()) {
    if (refusal_ == PlayersPlace(config_.name)) {
      const auto send = [&](ByteView out) { net_.Send(config_.server, out); };
      SayGoodbye(now_us, link, [&] { link->Flush(now_us, send); });
    }
    next_.reset();
    OnRefusal(now_us, std::exchange(refusal_, {}));
  }
  return good;
}

void Client::OnOffered(std::int64_t now_us, ByteView bytes) {
  const AnyMessage any = Decode(bytes);
  if (const auto* welcome = std::get_if<Welcome>(&any)) {
    if (knocks_at_ && welcome->epoch <= epoch_) {
      refusal_ = "it has our room in the epoch of our server";
      return;
    }
    if (welcome->epoch < epoch_) {
      refusal_ = "it has epoch " + std::to_string(welcome->epoch) +
                 " of the room, which has gone on elsewhere to " + std::to_string(epoch_);
      return;
    }
    if (config_.watch && welcome->player >= 0) {
      refusal_ = PlayersPlace(config_.name);
      return;
    }
    if (knocks_at_) config_.server = *knocks_at_;
    Forget(now_us);
    link_ = std::move(next_);
    at_ = config_.server;
    key_of_ = next_of_;
    offers_.Clear();
    OnWelcome(now_us, *welcome);
  } else if (const auto* redirect = std::get_if<Redirect>(&any)) {
    redirect_ = *redirect;
  } else if (const auto* bye = std::get_if<Bye>(&any)) {
    refusal_ = bye->reason;
  }
}

void Client::Follow(std::int64_t now_us, const Redirect& redirect) {
  Address to;
  if (knocks_at_ && redirect.epoch <= epoch_) return;  // to where we are
  if (!ReadAddress(redirect.address, &to) || redirect.epoch < epoch_) {
    ++stats_.dropped_malformed;
    return;
  }
  const bool again = to == away_ && redirect.epoch == epoch_;  // the same answer, asked once more
  if (!again && ++redirects_ > kRedirectsMax) {
    fatal_ = "the servers redirect again and again, now to " + redirect.address;
    return;
  }
  epoch_ = redirect.epoch;
  config_.room = redirect.room;
  away_ = to;
  Move(now_us, to);
}

void Client::Move(std::int64_t now_us, const Address& server) {
  if (peer_ >= 0 && !moving_) {
    moving_ = true;
    joining_since_us_ = now_us;
  }
  config_.server = server;
  knocks_at_.reset();
  BeginJoin(now_us);
}

void Client::TryElsewhere(std::int64_t now_us) {
  const bool joining = peer_ < 0 || moving_;
  const bool later = suggested_ && suggested_->epoch > epoch_;
  if (!joining) {
    const bool silent = now_us - answered_us_ > kElsewhereUs && PongOverdue(now_us);
    const bool knocks = later && knocks_at_ && *knocks_at_ == suggested_->server;
    if (later && silent && !knocks && suggested_->server != config_.server) {
      return Move(now_us, suggested_->server);
    }
    return KnockIfSilent(now_us);
  }
  const bool known = suggested_ && suggested_->epoch >= epoch_;
  if (known && suggested_->server != config_.server && offers_.empty()) {
    return Move(now_us, suggested_->server);
  }
  if (now_us - begun_us_ <= (offers_.empty() ? kElsewhereUs : kLostUs)) return;
  // No answer: the other server that we know, if there is one.
  const bool at_home = config_.server == home_;
  const Address& other = at_home ? away_ : home_;
  const bool sent_on = moving_ && other == at_;  // by that one
  if (!known && other.port != 0 && other != config_.server && !sent_on) return Move(now_us, other);
  if (moving_ && !offers_.empty()) BeginJoin(now_us);
}

void Client::OnRefusal(std::int64_t now_us, const std::string& reason) {
  if (knocks_at_) return;  // our session is with another server
  const std::string other = OtherProtocol(reason);
  const bool players = reason == PlayersPlace(config_.name);
  const bool in_use = reason.rfind("the name " + config_.name + " is in use", 0) == 0;
  if (config_.numbers_name && (players || in_use)) {
    config_.name = "guest-" + std::to_string(++name_number_);
    if (players) return BeginJoin(now_us);  // the server may still have that session
    BeginOffers();
    return;
  }
  if (players) {
    fatal_ = reason;
    return;
  }
  why_refused_ = reason;
  // Our own earlier session may still hold the name: retry for a while.
  if (refused_us_ < 0) {
    refused_us_ = now_us;
    // Whoever was in a room waits for it.
    if (epoch_ > 0) notice_ = ToString(config_.server) + " refuses: " + reason + "; asking on";
  }
  if (!other.empty()) {
    fatal_ = other;
  } else if (now_us - refused_us_ > (moving_ ? kInsistMovingUs : kInsistUs)) {
    fatal_ = "the server refuses: " + reason;
  }
}

void Client::AskNames(std::int64_t now_us) {
  if (asked_names_us_ < 0) {
    asked_names_us_ = now_us;
    Hello hello;
    hello.utime = now_us;
    hello.name = config_.name;
    link_->SendReliable(Encode(hello));
  } else if (now_us - asked_names_us_ > kNamesUs) {
    GiveUpName("");
  }
}

void Client::GiveUpName(const std::string& free) {
  std::vector<std::string> names;
  for (const Player& player : scene_->players) names.push_back(player.name);
  const std::string nearest = NearestName(config_.name, names);
  fatal_ = "there is no player \"" + config_.name + "\" here";
  if (!nearest.empty()) fatal_ += " (did you mean " + nearest + "?)";
  std::string all = names.empty() ? "the scene has none" : "the players are ";
  for (std::size_t i = 0; i < names.size(); ++i) all += (i > 0 ? ", " : "") + names[i];
  fatal_ += "; " + (free.empty() ? all : free) + "; --watch only looks on";
}

void Client::OnWelcome(std::int64_t now_us, const Welcome& welcome) {
  if (peer_ >= 0) return;
  if (welcome.peer < 1 || welcome.room_bytes < 1 ||
      static_cast<std::size_t>(welcome.room_bytes) > kPackedRoomBytesMax) {
    fatal_ = "the server's welcome makes no sense";
    return;
  }
  peer_ = welcome.peer;
  player_ = welcome.player;
  key_ = welcome.key;
  epoch_ = proved_epoch_ = welcome.epoch;
  proof_ = welcome.proof;
  answered_us_ = now_us;
  room_size_ = static_cast<std::size_t>(welcome.room_bytes);
}

}  // namespace seam
