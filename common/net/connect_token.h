#pragma once
/// Connect tokens: an operator's word that somebody may join a room under a name, for a short time
/// and once. In the shape of netcode 1.02's: a sealed part that only the servers with the
/// operator's key can read, and the same session keys in the open for the client that holds it.
/// A token is a secret until it is used or has expired.
///
///   pass, which the client sends on:   version info 13 | protocol u64 | created u64 | expires u64
///   |
///                                      nonce 24 | sealed 160 + 16
///   sealed, XChaCha20-Poly1305:        permissions u32 | name 33 | room 33 | two keys 64 | zeros
///   token, which the client reads:     pass | name 33 | room 33 | two keys 64, as hex digits
///
/// Numbers are big-endian, times in s since 1970, names have their length before them. What stands
/// before the nonce is authenticated too. docs/protocol.md is the reference.

#include <cstdint>
#include <string>

#include "common/base/bytes.h"
#include "common/base/entropy.h"
#include "common/base/status.h"
#include "common/net/key_exchange.h"

namespace seam {

/// Bytes of a pass, and of a whole token.
constexpr std::size_t kTokenPassBytes = 13 + 8 + 8 + 8 + 24 + 160 + 16;
constexpr std::size_t kTokenBytes = kTokenPassBytes + 33 + 33 + 64;
/// A token's usual life, s, as netcode recommends: enough to start a client.
constexpr std::int64_t kTokenLifeS = 45;

/// What a token says.
struct TokenGrant {
  std::uint32_t protocol = 0;
  std::string room, name;  ///< 1..32 characters each
  bool may_play = true;    ///< else it may only look on
  std::int64_t created_s = 0, expires_s = 0;
  TokenKeys keys;
};

/// A token as its client has it.
struct ConnectToken {
  std::string room, name;
  TokenKeys keys;
  Bytes pass;
};

/// Makes a token; draws its keys and its nonce. Returns its text, one line without its end.
/// Requires names of 1..32 bytes.
std::string MakeToken(const TokenGrant& grant, const Secret& operator_key, Entropy& entropy);

/// Reads a token's text, with or without a line end. Says why not, for example "is cut off".
Status ReadToken(const std::string& text, ConnectToken* token);

/// What the server that gets a pass expects of it.
struct TokenNeed {
  std::uint32_t protocol = 0;
  std::string room;  ///< "": any
  std::string name;
  std::int64_t now_s = 0;
};
/// Opens a pass. Says why it is refused, in one line for its client: "the token has expired".
Status OpenPass(ByteView pass, const Secret& operator_key, const TokenNeed& need,
                TokenGrant* grant);

/// Returns the bytes of a pass by which it is known, if it comes a second time: 16.
inline const std::uint8_t* TagOfPass(ByteView pass) { return pass.end() - Seal::kTagBytes; }

}  // namespace seam
