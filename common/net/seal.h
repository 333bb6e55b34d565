#pragma once
/// Encrypts and authenticates the datagrams of a session: ChaCha20-Poly1305 of RFC 8439 (the IETF
/// form: a nonce of 96 bits), from libsodium. Each direction has a key of its own; the nonce is the
/// datagram's whole 64-bit number, so no two datagrams share one and none counts a second time.

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/bytes.h"
#include "common/base/entropy.h"

namespace seam {

/// 32 secret bytes. Wiped when they go; compared in constant time; never printed.
class Secret {
 public:
  static constexpr std::size_t kSecretBytes = 32;

  Secret() = default;
  explicit Secret(Entropy& entropy);
  Secret(const Secret&) = default;
  Secret& operator=(const Secret&) = default;
  ~Secret();

  bool operator==(const Secret& other) const;
  bool operator!=(const Secret& other) const { return !(*this == other); }
  std::uint8_t* data() { return bytes_.data(); }
  const std::uint8_t* data() const { return bytes_.data(); }

 private:
  std::array<std::uint8_t, kSecretBytes> bytes_{};
};

/// Overwrites bytes that were secret, so that the compiler does not leave it out.
void Wipe(void* bytes, std::size_t size);

/// Keys of one end of a session; the other end has `out` and `in` the other way round.
struct SealKeys {
  std::uint64_t session = 0;   ///< number of the session in its datagrams, not 0
  Secret out, in;              ///< of the datagrams that this end sends, and receives
  std::uint32_t protocol = 0;  ///< authenticated with each datagram, as are the following
  std::uint64_t room = 0;      ///< hash of the room's name
  bool server = false;         ///< this end is the server's

  /// Returns the keys of the other end.
  SealKeys Mirrored() const;
};

class Seal {
 public:
  /// Bytes by which a sealed datagram is longer.
  static constexpr std::size_t kTagBytes = 16;

  explicit Seal(const SealKeys& keys);

  std::uint64_t session() const { return keys_.session; }
  /// Encrypts the datagram of this number (1 and up) in place from byte `from` on, and appends the
  /// tag. The bytes before are authenticated too.
  void Close(std::int64_t number, std::size_t from, Bytes* datagram) const;
  /// Writes the datagram without its tag, and decrypted from byte `from` on, to `plain`. False,
  /// with `plain` undefined, if the other end did not seal exactly this datagram under this number.
  bool Open(std::int64_t number, std::size_t from, ByteView datagram, Bytes* plain) const;

 private:
  /// magic to session of the datagram, protocol, room, direction.
  using Context = std::array<std::uint8_t, 64>;
  std::size_t MakeContext(ByteView head, bool from_server, Context* context) const;

  SealKeys keys_;
};

}  // namespace seam
