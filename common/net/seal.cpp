#include "common/net/seal.h"

#include <sodium.h>

#include <algorithm>
#include <utility>

#include "common/base/check.h"

namespace seam {
namespace {

static_assert(crypto_aead_chacha20poly1305_ietf_KEYBYTES == Secret::kSecretBytes);
static_assert(crypto_aead_chacha20poly1305_ietf_ABYTES == Seal::kTagBytes);

using Nonce = std::array<std::uint8_t, crypto_aead_chacha20poly1305_ietf_NPUBBYTES>;

/// Returns four zeros and the number, little-endian, as netcode 1.02 has it.
Nonce NonceOf(std::int64_t number) {
  Nonce nonce{};
  for (std::size_t i = 0; i < 8; ++i) {
    nonce[4 + i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> (8 * i));
  }
  return nonce;
}

}  // namespace

Secret::Secret(Entropy& entropy) {
  for (std::size_t i = 0; i < kSecretBytes; i += 8) {
    std::uint64_t bits = entropy.Next();
    for (std::size_t j = 0; j < 8; ++j) bytes_[i + j] = static_cast<std::uint8_t>(bits >> (8 * j));
    Wipe(&bits, sizeof bits);
  }
}

Secret::~Secret() { Wipe(bytes_.data(), bytes_.size()); }

bool Secret::operator==(const Secret& other) const {
  return sodium_memcmp(data(), other.data(), kSecretBytes) == 0;
}

void Wipe(void* bytes, std::size_t size) { sodium_memzero(bytes, size); }

SealKeys SealKeys::Mirrored() const {
  SealKeys other = *this;
  std::swap(other.out, other.in);
  other.server = !server;
  return other;
}

Seal::Seal(const SealKeys& keys) : keys_(keys) {
  // Selects the fastest implementation for this processor; later calls do nothing.
  static const bool ready = sodium_init() >= 0;
  SEAM_ASSERT(ready && keys.session != 0);
}

std::size_t Seal::MakeContext(ByteView head, bool from_server, Context* context) const {
  constexpr std::size_t kMore = 4 + 8 + 1;
  SEAM_ASSERT(head.size + kMore <= context->size());
  std::uint8_t* at = std::copy(head.begin(), head.end(), context->begin());
  for (int i = 0; i < 4; ++i) *at++ = static_cast<std::uint8_t>(keys_.protocol >> (24 - 8 * i));
  for (int i = 0; i < 8; ++i) *at++ = static_cast<std::uint8_t>(keys_.room >> (56 - 8 * i));
  *at = from_server ? 1 : 0;
  return head.size + kMore;
}

void Seal::Close(std::int64_t number, std::size_t from, Bytes* datagram) const {
  SEAM_ASSERT(number > 0 && from <= datagram->size());
  Context context;
  const std::size_t known = MakeContext({datagram->data(), from}, keys_.server, &context);
  const Nonce nonce = NonceOf(number);
  const std::size_t bytes = datagram->size() - from;
  datagram->resize(datagram->size() + kTagBytes);
  std::uint8_t* const at = datagram->data() + from;
  (void)crypto_aead_chacha20poly1305_ietf_encrypt(at, nullptr, at, bytes, context.data(), known,
                                                  nullptr, nonce.data(), keys_.out.data());
}

bool Seal::Open(std::int64_t number, std::size_t from, ByteView datagram, Bytes* plain) const {
  if (number <= 0 || datagram.size < from + kTagBytes) return false;
  Context context;
  const std::size_t known = MakeContext({datagram.data, from}, !keys_.server, &context);
  const Nonce nonce = NonceOf(number);
  plain->resize(datagram.size - kTagBytes);
  std::copy(datagram.data, datagram.data + from, plain->begin());
  return crypto_aead_chacha20poly1305_ietf_decrypt(
             plain->data() + from, nullptr, nullptr, datagram.data + from, datagram.size - from,
             context.data(), known, nonce.data(), keys_.in.data()) == 0;
}

}  // namespace seam
