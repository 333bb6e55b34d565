#include "common/net/keyed_hash.h"

#include <sodium/crypto_shorthash.h>

namespace seam {

static_assert(crypto_shorthash_KEYBYTES == sizeof(HashKey));
static_assert(crypto_shorthash_BYTES == 8);

HashKey DrawHashKey(Entropy& entropy) {
  HashKey key{};
  for (std::size_t i = 0; i < key.size(); i += 8) {
    const std::uint64_t bits = entropy.Next();
    for (std::size_t j = 0; j < 8; ++j) key[i + j] = static_cast<std::uint8_t>(bits >> (8 * j));
  }
  return key;
}

std::uint64_t KeyedHash(const HashKey& key, ByteView bytes) {
  unsigned char hash[crypto_shorthash_BYTES];
  crypto_shorthash(hash, bytes.data, bytes.size, key.data());
  std::uint64_t value = 0;
  for (int i = 7; i >= 0; --i) value = value << 8 | hash[i];  // little-endian, as in the paper
  return value;
}

}  // namespace seam
