#pragma once
/// What a peer knows of one player's inputs: exact for the ticks received, held after the newest.

#include <cstdint>
#include <map>

#include "common/codec/messages.h"
#include "common/scene/types.h"

namespace seam {

class InputTrack {
 public:
  /// Takes over the ticks it did not know. Ticks more than kKeepTicks behind are forgotten.
  void Note(std::int64_t tick, const Input& input);
  void Note(const Inputs& inputs);

  bool knows(std::int64_t tick) const { return known_.count(tick) != 0; }
  /// The input of `tick`; where unknown, the newest known one before it.
  Input At(std::int64_t tick) const;
  /// Whether a known input of `from` or later is another than who knows only those before it would
  /// take it to be.
  bool Surprises(std::int64_t from) const;
  std::int64_t newest() const { return known_.empty() ? -1 : known_.rbegin()->first; }

  /// Buttons that went down in ticks heard of and <= `tick`, each reported once. They may be late:
  /// a relayed input arrives after its tick.
  std::int16_t TakePresses(std::int64_t tick);

  /// Buttons that went down at exactly this tick, as far as it is known.
  std::int16_t PressedAt(std::int64_t tick) const;

  /// The last `count` known successive ticks up to `newest()`, for the wire; all if there are less.
  Inputs Export(int player, int count) const;

  static constexpr std::int64_t kKeepTicks = 600;

 private:
  std::map<std::int64_t, Input> known_;
  std::int64_t presses_taken_until_ = -1;
};

}  // namespace seam
