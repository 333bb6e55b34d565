#pragma once
/// What a peer knows of one player's inputs: exact for the ticks received, held after the newest.

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/scene/types.h"

namespace seam {

class InputTrack {
 public:
  /// Takes over the ticks it did not know. Ticks more than kKeepTicks behind are forgotten.
  void Note(std::int64_t tick, const Input& input);
  void Note(const Inputs& inputs);

  bool knows(std::int64_t tick) const { return Find(tick) != nullptr; }
  /// The input of `tick`; where unknown, the newest known one before it.
  Input At(std::int64_t tick) const;
  /// Whether a known input of `from` or later is another than who knows only those before it would
  /// take it to be.
  bool Surprises(std::int64_t from) const;
  std::int64_t newest() const { return newest_; }  ///< -1: none

  /// Buttons that went down in ticks heard of and <= `tick`, each reported once. They may be late:
  /// a relayed input arrives after its tick.
  std::int16_t TakePresses(std::int64_t tick);

  /// Buttons that went down at exactly this tick, as far as it is known.
  std::int16_t PressedAt(std::int64_t tick) const;

  /// The last `count` known successive ticks up to `newest()`, for the wire; all if there are less.
  Inputs Export(int player, int count) const;
  /// The same, into a message that keeps its memory; its utime and sequence stay.
  void Export(int player, int count, Inputs* to) const;

  static constexpr std::int64_t kKeepTicks = 600;

 private:
  struct Known {
    std::int64_t tick = -1;
    Input input;
  };
  static std::size_t Place(std::int64_t tick) {
    return static_cast<std::size_t>(tick % (kKeepTicks + 1));
  }
  const Known* Find(std::int64_t tick) const;
  /// The newest known one at or before `tick`; nullptr: there is none.
  const Known* Before(std::int64_t tick) const;
  int ButtonsBefore(std::int64_t tick) const;
  void FindNewestChange();

  std::vector<Known> ring_;  // by tick modulo its size; empty: nothing is known
  std::int64_t newest_ = -1, oldest_ = -1;
  std::int64_t newest_change_ = -1;  // known, and another than the known one before it
  std::int64_t presses_taken_until_ = -1;
};

}  // namespace seam
