#include "client/join_offers.h"

#include <algorithm>

namespace seam {

void JoinOffers::Begin(Entropy& entropy, std::uint64_t number, const std::string& name,
                       const std::string& room, const ConnectToken* token, std::int32_t epoch,
                       std::int64_t proof) {
  offers_.clear();
  own_ = KeyPair(entropy);
  terms_ = JoinTerms();
  terms_.protocol = static_cast<std::uint32_t>(kProtocolVersion);
  terms_.number = number;
  terms_.name = name;
  terms_.room = room;
  terms_.client = own_.open;
  terms_.epoch = epoch;
  terms_.proof = proof;
  token_keys_.reset();
  if (token == nullptr) return;
  token_keys_ = token->keys;
  terms_.pass = token->pass;
}

bool JoinOffers::Take(const Challenge& challenge) {
  JoinTerms terms = terms_;
  terms.cookie = challenge.token;
  const auto half = challenge.keys.begin() + static_cast<std::ptrdiff_t>(terms.ephemeral.size());
  std::copy(challenge.keys.begin(), half, terms.ephemeral.begin());
  std::copy(half, challenge.keys.end(), terms.identity.begin());
  if (!offers_.empty()) {
    const JoinTerms& last = offers_.back().terms;
    if (last.cookie == terms.cookie && last.ephemeral == terms.ephemeral &&
        last.identity == terms.identity) {
      return false;
    }
  }
  const auto secrets =
      JoinSecrets::OfClient(terms, own_.secret, token_keys_ ? &*token_keys_ : nullptr);
  if (!secrets) return false;
  if (offers_.size() == kOffersMax) offers_.erase(offers_.begin());
  offers_.push_back({terms, *secrets});
  return true;
}

void JoinOffers::Clear() {
  offers_.clear();
  own_ = KeyPair();
  token_keys_.reset();
}

Join JoinOffers::Make(std::int64_t now_us, std::int64_t place_key) const {
  const Offer& offer = offers_.back();
  Join join;
  join.utime = now_us;
  join.token = offer.terms.cookie;
  join.name = offer.terms.name;
  join.room = offer.terms.room;
  join.exchange.assign(offer.terms.client.begin(), offer.terms.client.end());
  const SealedKey sealed = offer.secrets.CloseKey(place_key);
  join.exchange.insert(join.exchange.end(), sealed.begin(), sealed.end());
  join.grant = offer.terms.pass;
  join.epoch = offer.terms.epoch;
  join.proof = offer.terms.proof;
  return join;
}

const SealKeys* JoinOffers::Find(std::uint64_t session, PublicKey* identity) const {
  const auto found = std::find_if(offers_.begin(), offers_.end(), [&](const Offer& offer) {
    return offer.secrets.keys().session == session;
  });
  if (found == offers_.end()) return nullptr;
  *identity = found->terms.identity;
  return &found->secrets.keys();
}

}  // namespace seam
