#pragma once
/// Keyed hashes of a stream of bytes, each continued from the last: BLAKE2b with 32 bytes (RFC
/// 7693), from libsodium. Without the key nobody can change, remove or insert bytes and give them a
/// hash that fits.

#include <array>
#include <cstdint>
#include <memory>

#include "common/base/bytes.h"
#include "common/net/seal.h"

namespace seam {

class KeyedChain {
 public:
  using Hash = std::array<std::uint8_t, 32>;

  /// Begins behind the bytes with the hash `last`; zeros: at the begin of the stream.
  explicit KeyedChain(const Secret& key, const Hash& last = {});
  KeyedChain(const KeyedChain& other);
  KeyedChain& operator=(const KeyedChain& other);
  ~KeyedChain();

  void Add(ByteView bytes);
  /// Returns the hash of `last` and the bytes since.
  Hash Now() const;
  /// Compares with Now(), in a time that does not depend on the bytes.
  bool Is(const Hash& told) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace seam
