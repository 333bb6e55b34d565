#pragma once
/// The server's key pairs for joins: a new one in each time slot. They last as long as the address
/// tokens of their slot, and are then wiped: what was said under them stays secret even from
/// somebody who later steals all that the server knows.

#include <cstdint>
#include <utility>

#include "common/base/entropy.h"
#include "common/net/key_exchange.h"

namespace seam {

class SlotKeys {
 public:
  explicit SlotKeys(Entropy& entropy) : entropy_(entropy) {}

  /// Returns the pair of this slot, the newest so far; draws it if need be.
  const KeyPair& Draw(std::int64_t slot) {
    if (slot != newest_.slot) {
      before_ = std::exchange(newest_, Slot{slot, KeyPair(entropy_)});
    }
    return newest_.keys;
  }
  /// Returns the pair that was drawn in the slot; nullptr if there is none any more.
  const KeyPair* Find(std::int64_t slot) const {
    if (slot < 0) return nullptr;
    if (slot == newest_.slot) return &newest_.keys;
    return slot == before_.slot ? &before_.keys : nullptr;
  }

  /// Wipes the pairs whose address tokens are too old in this slot.
  void Forget(std::int64_t slot) {
    for (Slot* const pair : {&newest_, &before_}) {
      if (pair->slot >= 0 && pair->slot < slot - 1) *pair = Slot();
    }
  }

 private:
  struct Slot {
    std::int64_t slot = -1;
    KeyPair keys;
  };
  Entropy& entropy_;
  Slot newest_, before_;
};

}  // namespace seam
