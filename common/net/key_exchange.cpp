#include "common/net/key_exchange.h"

#include <sodium.h>

#include <algorithm>

#include "common/base/check.h"

namespace seam {
namespace {

static_assert(crypto_scalarmult_BYTES == Secret::kSecretBytes);
static_assert(crypto_scalarmult_SCALARBYTES == Secret::kSecretBytes);

/// Multiplies. False if the result is 0, so that it would not depend on `own`.
bool Multiply(const Secret& own, const PublicKey& other, Secret* shared) {
  return crypto_scalarmult(shared->data(), own.data(), other.data()) == 0;
}

/// BLAKE2b over fields, each of a known or a told length.
class Transcript {
 public:
  Transcript() { (void)crypto_generichash_init(&state_, nullptr, 0, Secret::kSecretBytes); }
  ~Transcript() { Wipe(&state_, sizeof state_); }
  Transcript(const Transcript&) = delete;
  Transcript& operator=(const Transcript&) = delete;

  void Add(const void* bytes, std::size_t size) {
    (void)crypto_generichash_update(&state_, static_cast<const unsigned char*>(bytes), size);
  }
  void Add(std::uint64_t number) {
    std::uint8_t bytes[8];
    for (int i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(number >> (56 - 8 * i));
    Add(bytes, sizeof bytes);
  }
  void AddText(const std::string& text) {
    Add(text.size());
    Add(text.data(), text.size());
  }
  void End(Secret* hash) {
    (void)crypto_generichash_final(&state_, hash->data(), Secret::kSecretBytes);
  }

 private:
  crypto_generichash_state state_;
};

/// Derives key `index` of the session.
Secret Derived(const Secret& master, std::uint64_t index) {
  static const char kContext[crypto_kdf_CONTEXTBYTES + 1] = "seamjoin";
  Secret key;
  (void)crypto_kdf_derive_from_key(key.data(), Secret::kSecretBytes, index, kContext,
                                   master.data());
  return key;
}

/// Of the place's key in a join, which is the only thing that its key seals.
constexpr std::uint8_t kBoxNonce[crypto_aead_chacha20poly1305_ietf_NPUBBYTES] = {};

}  // namespace

KeyPair::KeyPair(const Secret& own) : secret(own) {
  (void)crypto_scalarmult_base(open.data(), secret.data());
}

JoinSecrets::JoinSecrets(const JoinTerms& terms, const Secret& both_ephemeral,
                         const Secret& with_identity, const TokenKeys* token, bool server) {
  Transcript transcript;
  transcript.AddText("Seam2D session keys 1");
  transcript.Add(both_ephemeral.data(), Secret::kSecretBytes);
  transcript.Add(with_identity.data(), Secret::kSecretBytes);
  transcript.Add(token == nullptr ? 0 : 1);
  if (token != nullptr) transcript.Add(token->to_server.data(), Secret::kSecretBytes);
  if (token != nullptr) transcript.Add(token->to_client.data(), Secret::kSecretBytes);
  transcript.Add(terms.protocol);
  transcript.Add(terms.number);
  transcript.Add(static_cast<std::uint64_t>(terms.cookie));
  transcript.AddText(terms.name);
  transcript.AddText(terms.room);
  for (const PublicKey& key : {terms.client, terms.ephemeral, terms.identity}) {
    transcript.Add(key.data(), key.size());
  }
  transcript.Add(terms.pass.size());
  transcript.Add(terms.pass.data(), terms.pass.size());
  transcript.Add(static_cast<std::uint64_t>(terms.epoch));
  transcript.Add(static_cast<std::uint64_t>(terms.proof));
  Secret master;
  transcript.End(&master);
  const Secret to_server = Derived(master, 1), to_client = Derived(master, 2);
  keys_.out = server ? to_client : to_server;
  keys_.in = server ? to_server : to_client;
  box_ = Derived(master, 3);
  const Secret number = Derived(master, 4);
  for (int i = 0; i < 8; ++i) keys_.session = keys_.session << 8 | number.data()[i];
  keys_.session = std::max<std::uint64_t>(keys_.session, 1);
  keys_.protocol = terms.protocol;
  keys_.room = Fnv1a(terms.room.data(), terms.room.size());
  keys_.server = server;
}

std::optional<JoinSecrets> JoinSecrets::OfClient(const JoinTerms& terms, const Secret& own,
                                                 const TokenKeys* token) {
  Secret both, with;
  if (!Multiply(own, terms.ephemeral, &both) || !Multiply(own, terms.identity, &with)) return {};
  return JoinSecrets(terms, both, with, token, false);
}

std::optional<JoinSecrets> JoinSecrets::OfServer(const JoinTerms& terms, const Secret& ephemeral,
                                                 const Secret& identity, const TokenKeys* token) {
  Secret both, with;
  if (!Multiply(ephemeral, terms.client, &both) || !Multiply(identity, terms.client, &with)) {
    return {};
  }
  return JoinSecrets(terms, both, with, token, true);
}

SealedKey JoinSecrets::CloseKey(std::int64_t place_key) const {
  std::uint8_t bytes[8];
  for (int i = 0; i < 8; ++i) {
    bytes[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(place_key) >> (56 - 8 * i));
  }
  SealedKey sealed{};
  (void)crypto_aead_chacha20poly1305_ietf_encrypt(sealed.data(), nullptr, bytes, sizeof bytes,
                                                  nullptr, 0, nullptr, kBoxNonce, box_.data());
  Wipe(bytes, sizeof bytes);
  return sealed;
}

std::optional<std::int64_t> JoinSecrets::OpenKey(const SealedKey& sealed) const {
  std::uint8_t bytes[8];
  if (crypto_aead_chacha20poly1305_ietf_decrypt(bytes, nullptr, nullptr, sealed.data(),
                                                sealed.size(), nullptr, 0, kBoxNonce,
                                                box_.data()) != 0) {
    return {};
  }
  std::uint64_t key = 0;
  for (const std::uint8_t byte : bytes) key = key << 8 | byte;
  Wipe(bytes, sizeof bytes);
  return static_cast<std::int64_t>(key);
}

std::int64_t EpochProof(const Secret& identity, const std::string& room, std::int32_t epoch) {
  Transcript transcript;
  transcript.AddText("Seam2D room epoch 1");
  transcript.Add(identity.data(), Secret::kSecretBytes);
  transcript.AddText(room);
  transcript.Add(static_cast<std::uint64_t>(epoch));
  Secret hash;
  transcript.End(&hash);
  std::uint64_t proof = 0;
  for (int i = 0; i < 8; ++i) proof = proof << 8 | hash.data()[i];
  return static_cast<std::int64_t>(proof);
}

bool SameKey(const PublicKey& a, const PublicKey& b) {
  return sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace seam
