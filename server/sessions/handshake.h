#pragma once
/// Answers datagrams of senders without a session; keeps no session state for them. A Hello is
/// answered by a Challenge; a Join is passed on only with a valid token of a Challenge, and if its
/// sender has the keys.

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "common/base/entropy.h"
#include "common/codec/messages.h"
#include "common/net/connect_token.h"
#include "common/net/key_exchange.h"
#include "common/net/net.h"
#include "server/sessions/address_token.h"
#include "server/sessions/byte_credit.h"
#include "server/sessions/slot_keys.h"
#include "server/sessions/token_door.h"
#include "server/sessions/traffic_count.h"
#include "server/sessions/used_once.h"

namespace seam {

/// A client that asks to come in, and has proved its address.
struct JoinRequest {
  std::string name;
  std::string room;            ///< "": the server's first
  std::int64_t place_key = 0;  ///< 0: none
  std::int32_t epoch = 0;      ///< highest of the room that the client has seen; 0: none
  bool epoch_proved = false;   ///< a server with our lasting key has told it
  bool token = false;          ///< has a connect token, which is right
  bool may_play = true;        ///< else the token lets it only look on
  SealKeys keys;               ///< of the session to be
  UsedOnce::Tag tag{};         ///< of its key pair
  UsedOnce::Tag token_tag{};
  std::int64_t token_until_us = 0;
};

class Handshake {
 public:
  /// All must outlive it. Draws its secrets from `entropy`. `identity`: the server's lasting keys;
  /// `traffic` counts what is sent; `door`: whom the room lets in.
  Handshake(Net& net, Entropy& entropy, const KeyPair& identity, TrafficCount& traffic,
            TokenDoor door = {})
      : net_(net),
        identity_(identity),
        traffic_(traffic),
        door_(std::move(door)),
        token_(entropy),
        credit_(entropy),
        slot_keys_(entropy) {}

  enum class Verdict {
    kJoins,     ///< has proved its address; `request` is what it asks for
    kAnswered,  ///< by a Challenge or a refusal, or not at all for lack of credit
    kForeign,   ///< neither Hello nor Join
  };
  /// Handles the message of a loose datagram (LooseNumber is `number`). Decodes the message only if
  /// it is a Hello or a Join.
  Verdict Receive(std::int64_t now_us, const Address& from, std::uint64_t number, ByteView datagram,
                  JoinRequest* request);
  /// Notes that the request was granted: its keys count no second time.
  void NoteGranted(std::int64_t now_us, const JoinRequest& request);
  /// Answers the request by a redirect, in a sealed session of one datagram; the same join gets the
  /// same datagram again. `redirect`: its utime is `now_us`.
  void AnswerByRedirect(std::int64_t now_us, const Address& to, const JoinRequest& request,
                        Redirect redirect);

  /// Sends the reason of a refusal, in answer to a datagram of `sent_bytes`, if the address's byte
  /// credit allows. `proved`: the sender has proved its address.
  void Refuse(std::int64_t now_us, const Address& to, std::uint64_t number, std::size_t sent_bytes,
              const std::string& reason, bool proved);

  /// Tells the sender of a sealed datagram that its session is not known here, as after a restart,
  /// likewise.
  void RefuseSession(std::int64_t now_us, const Address& to, ByteView datagram);

  /// Wipes keys that no join can need any more. To be called at least every second.
  void Forget(std::int64_t now_us) { slot_keys_.Forget(AddressToken::SlotAt(now_us)); }

  /// Adds the bytes and datagrams sent since the last call to `stats`.
  void Count(Stats* stats);

  /// Joins that are computed in a second, on average and at once, whoever sends them: each costs
  /// about 0.1 ms. A client whose join is left out repeats it.
  static constexpr double kJoinsPerSecond = 1000, kJoinsAtOnce = 256;

 private:
  void Challenge(std::int64_t now_us, const Address& to, std::uint64_t number,
                 std::size_t sent_bytes);
  Verdict OnJoin(std::int64_t now_us, const Address& from, std::uint64_t number,
                 std::size_t sent_bytes, const Join& join, JoinRequest* request);
  /// Reads the token of a join into the request and `grant`. Returns why it is refused, or "".
  std::string ReadPass(std::int64_t now_us, const Join& join, JoinRequest* request,
                       TokenGrant* grant) const;
  bool MayCompute(std::int64_t now_us);
  void Send(const Address& to, const Bytes& datagram);

  Net& net_;
  const KeyPair& identity_;
  TrafficCount& traffic_;
  const TokenDoor door_;
  const AddressToken token_;
  ByteCredit credit_;
  SlotKeys slot_keys_;
  UsedOnce used_;
  struct RedirectSent {
    Bytes datagram;
    std::int64_t until_us = 0;
  };
  std::map<UsedOnce::Tag, RedirectSent> redirects_;  // those that may be asked for again
  double joins_left_ = kJoinsAtOnce;
  std::int64_t filled_us_ = -1;
  std::int64_t bytes_ = 0, datagrams_ = 0;  // sent since the last Count
};

}  // namespace seam
