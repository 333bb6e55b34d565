#include "common/net/keyed_hash.h"

#include <sodium/crypto_shorthash.h>

namespace seam {

static_assert(crypto_shorthash_KEYBYTES == sizeof(HashKey));
static_assert(crypto_shorthash_BYTES == 8);

std::uint64_t KeyedHash(const HashKey& key, ByteView bytes) {
  unsigned char hash[crypto_shorthash_BYTES];
  crypto_shorthash(hash, bytes.data, bytes.size, key.data());
  std::uint64_t value = 0;
  for (int i = 7; i >= 0; --i) value = value << 8 | hash[i];  // little-endian, as the paper has it
  return value;
}

}  // namespace seam
