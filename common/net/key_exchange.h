#pragma once
/// The keys of a session: X25519 between a client and a server, each with a key pair for this join
/// alone (the server's lasts for a time slot) and the server also with its lasting one. Whoever
/// knows the lasting key alone cannot read a session that is over.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/base/bytes.h"
#include "common/base/entropy.h"
#include "common/net/seal.h"

namespace seam {

using PublicKey = std::array<std::uint8_t, 32>;

struct KeyPair {
  KeyPair() = default;
  explicit KeyPair(Entropy& entropy) : KeyPair(Secret(entropy)) {}
  explicit KeyPair(const Secret& secret);
  Secret secret;
  PublicKey open{};
};

/// Two keys that only the server and the holder of a connect token know.
struct TokenKeys {
  Secret to_server, to_client;
};

/// All that a handshake says in the open. Each field goes into the keys: if anything was changed on
/// the way, the two ends have different ones.
struct JoinTerms {
  std::uint32_t protocol = 0;
  std::uint64_t number = 0;  ///< drawn by the client
  std::int64_t cookie = 0;   ///< the address token of the challenge
  std::string name, room;
  PublicKey client{};     ///< the client's, for this join
  PublicKey ephemeral{};  ///< the server's, for a time slot
  PublicKey identity{};   ///< the server's, lasting
  Bytes pass;             ///< the sealed part of a connect token; empty: none
  std::int32_t epoch = 0;  ///< of the room, the highest that the client has seen; 0: none
  std::int64_t proof = 0;  ///< EpochProof of it; 0: none
};

/// Bytes of a place's key in a join: sealed, also if it is 0.
constexpr std::size_t kSealedKeyBytes = 8 + Seal::kTagBytes;
using SealedKey = std::array<std::uint8_t, kSealedKeyBytes>;

/// The outcome of a handshake at one end.
class JoinSecrets {
 public:
  /// Computes them at the client's end, whose key pair `own` is. `token`: the keys in its connect
  /// token; nullptr: none. Empty if a public key is none.
  static std::optional<JoinSecrets> OfClient(const JoinTerms& terms, const Secret& own,
                                             const TokenKeys* token);
  /// The same at the server's end.
  static std::optional<JoinSecrets> OfServer(const JoinTerms& terms, const Secret& ephemeral,
                                             const Secret& identity, const TokenKeys* token);

  const SealKeys& keys() const { return keys_; }
  SealedKey CloseKey(std::int64_t place_key) const;
  /// Empty if the other end does not have the same secrets.
  std::optional<std::int64_t> OpenKey(const SealedKey& sealed) const;

 private:
  JoinSecrets(const JoinTerms& terms, const Secret& both_ephemeral, const Secret& with_identity,
              const TokenKeys* token, bool server);

  SealKeys keys_;
  Secret box_;
};

/// Returns a hash of a room's name and epoch, keyed by a server's lasting key. A client that has it
/// was told so by a server with that key, so that nobody else can end a room by an invented epoch.
std::int64_t EpochProof(const Secret& identity, const std::string& room, std::int32_t epoch);

/// Compares in constant time.
bool SameKey(const PublicKey& a, const PublicKey& b);

}  // namespace seam
