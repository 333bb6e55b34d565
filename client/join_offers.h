#pragma once
/// The client's half of the key exchange. A server may challenge more than once before it grants a
/// join, so several exchanges stand open; the first datagram of the session shows which was taken.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/entropy.h"
#include "common/codec/messages.h"
#include "common/net/connect_token.h"
#include "common/net/key_exchange.h"

namespace seam {

class JoinOffers {
 public:
  /// Begins anew for the session `number`: forgets all offers and draws a key pair. `token`: to be
  /// shown, nullptr: none. `epoch` and `proof`: of the newest Welcome to the room; 0: none.
  void Begin(Entropy& entropy, std::uint64_t number, const std::string& name,
             const std::string& room, const ConnectToken* token = nullptr, std::int32_t epoch = 0,
             std::int64_t proof = 0);
  /// Makes an offer for the challenge. False if it is the newest one already, or has keys that are
  /// none.
  bool Take(const Challenge& challenge);
  /// Forgets all offers, and the key pair.
  void Clear();

  bool empty() const { return offers_.empty(); }
  /// Returns the Join for the newest offer.
  Join Make(std::int64_t now_us, std::int64_t place_key) const;
  /// Returns the lasting key of the server of the newest offer.
  const PublicKey& identity() const { return offers_.back().terms.identity; }
  /// Returns the keys of the sealed session of this number, and in `identity` its server's lasting
  /// key; nullptr: it is of no offer.
  const SealKeys* Find(std::uint64_t session, PublicKey* identity) const;

 private:
  struct Offer {
    JoinTerms terms;
    JoinSecrets secrets;
  };
  /// Most that stand open: of two rooms' worth of challenges, in two time slots.
  static constexpr std::size_t kOffersMax = 4;

  JoinTerms terms_;  // without the server's part
  KeyPair own_;
  std::optional<TokenKeys> token_keys_;
  std::vector<Offer> offers_;
};

}  // namespace seam
