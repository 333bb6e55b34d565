/// Client, joining: Hello, Challenge, Join, Welcome. See docs/protocol.md, "Joining".

#include <cstdio>
#include <variant>

#include "client/client.h"
#include "common/base/nearest.h"
#include "common/net/datagram.h"

namespace seam {
namespace {

/// An unanswered Hello or Join is repeated after this, us.
constexpr std::int64_t kHelloUs = 100000;
/// A refused join is repeated for this long, us.
constexpr std::int64_t kInsistUs = 3000000;

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

}  // namespace

void Client::Join(std::int64_t now_us) {
  do {
    session_ = entropy_.Next();
  } while (session_ == 0);
  link_ = std::make_unique<Link>(session_);
  unpacker_.reset();
  packer_.reset();
  token_.reset();
  token_fresh_ = false;
  replica_.reset();
  scene_.reset();
  snapshot_.reset();
  held_.Clear();
  room_bytes_.clear();
  room_size_ = 0;
  clock_ = ClockFilter();
  feed_ = InputFeed();
  metadata_ = MetaTable();
  if (peer_ >= 0 || joining_since_us_ == 0) joining_since_us_ = now_us;
  peer_ = player_ = -1;
  said_ready_ = started_ = released_ = loaded_now_ = false;
  timeline_ = RoomTimeline();
  lead_us_ = -1;
  answered_us_ = now_us;
  refused_us_ = asked_names_us_ = -1;
}

void Client::SendHelloOrJoin(std::int64_t now_us) {
  if (now_us - last_hello_us_ < kHelloUs && !token_fresh_) return;
  last_hello_us_ = now_us;
  token_fresh_ = false;
  if (!token_) {
    Hello hello;
    hello.utime = now_us;
    hello.name = config_.name;
    SendLoose(Encode(hello));
    return;
  }
  seam::Join join;
  join.utime = now_us;
  join.token = *token_;
  join.key = key_;
  join.name = config_.name;
  join.room = config_.room;
  SendLoose(Encode(join));
}

void Client::SendLoose(const Bytes& message) {
  const Bytes datagram = LooseDatagram(session_, message);
  stats_.bytes_out += static_cast<std::int64_t>(datagram.size());
  stats_.datagrams_out += 1;
  net_.Send(config_.server, datagram);
}

bool Client::OnHandshake(std::int64_t now_us, const Bytes& datagram) {
  DatagramHeader header;
  if (!ReadHeader(datagram, &header) || header.session != session_) return false;
  // Once we have joined, such a datagram is a late answer.
  if (peer_ >= 0) return header.loose();
  // Servers of older protocols refuse in a numbered datagram: the number is ignored.
  const AnyMessage any = Decode(FirstUnreliable(datagram));
  if (const auto* challenge = std::get_if<Challenge>(&any)) {
    token_fresh_ = token_ != challenge->token;
    token_ = challenge->token;
  } else if (const auto* bye = std::get_if<Bye>(&any)) {
    OnRefusal(now_us, bye->reason);
  } else {
    return header.loose();
  }
  return true;
}

void Client::OnRefusal(std::int64_t now_us, const std::string& reason) {
  const std::string other = OtherProtocol(reason);
  if (config_.numbers_name && reason.rfind("the name " + config_.name + " is in use", 0) == 0) {
    config_.name = "guest-" + std::to_string(++name_number_);
    return;
  }
  // Our own earlier session may still hold the name: retry for a while.
  if (refused_us_ < 0) refused_us_ = now_us;
  if (!other.empty()) {
    fatal_ = other;
  } else if (now_us - refused_us_ > kInsistUs) {
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
  answered_us_ = now_us;
  room_size_ = static_cast<std::size_t>(welcome.room_bytes);
}

}  // namespace seam
