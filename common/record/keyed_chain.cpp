#include "common/record/keyed_chain.h"

#include <sodium.h>

#include "common/base/check.h"

namespace seam {

struct KeyedChain::State {
  crypto_generichash_state hash;
};

KeyedChain::KeyedChain(const Secret& key, const Hash& last) : state_(std::make_unique<State>()) {
  SEAM_ASSERT(crypto_generichash_init(&state_->hash, key.data(), Secret::kSecretBytes,
                                      std::tuple_size<Hash>::value) == 0);
  Add({last.data(), last.size()});
}

KeyedChain::KeyedChain(const KeyedChain& other) : state_(std::make_unique<State>(*other.state_)) {}

KeyedChain& KeyedChain::operator=(const KeyedChain& other) {
  *state_ = *other.state_;
  return *this;
}

KeyedChain::~KeyedChain() { Wipe(&state_->hash, sizeof state_->hash); }

void KeyedChain::Add(ByteView bytes) {
  (void)crypto_generichash_update(&state_->hash, bytes.data, bytes.size);
}

KeyedChain::Hash KeyedChain::Now() const {
  State copy = *state_;
  Hash hash;
  (void)crypto_generichash_final(&copy.hash, hash.data(), hash.size());
  Wipe(&copy.hash, sizeof copy.hash);
  return hash;
}

bool KeyedChain::Is(const Hash& told) const {
  const Hash now = Now();
  return sodium_memcmp(now.data(), told.data(), now.size()) == 0;
}

}  // namespace seam
