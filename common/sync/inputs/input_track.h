#pragma once
/// One player's inputs as far as known: exact for the ticks received, held after the newest.

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/scene/types.h"

namespace seam {

class StateArchive;

class InputTrack {
 public:
  /// Adds unknown ticks. Forgets ticks more than kKeepTicks behind.
  void Note(std::int64_t tick, const Input& input);
  void Note(const Inputs& inputs);

  bool knows(std::int64_t tick) const { return Find(tick) != nullptr; }
  /// Returns the input of `tick`, or if unknown the newest known one before it.
  Input At(std::int64_t tick) const;
  /// True if a known input of `from` or later differs from the prediction of a peer that knows only
  /// the earlier ones.
  bool DiffersFromPrediction(std::int64_t from) const;
  std::int64_t newest() const { return newest_; }  ///< -1: none

  /// Returns the buttons that went down in known ticks <= `tick`, each once. They may be late: a
  /// relayed input arrives after its tick.
  std::int16_t TakePresses(std::int64_t tick);

  /// Returns the buttons that went down at exactly this tick, as far as known.
  std::int16_t PressedAt(std::int64_t tick) const;

  /// Returns the last `count` known successive ticks up to `newest()`, for the wire; all if there
  /// are fewer.
  Inputs Export(int player, int count) const;
  /// Like the above, into a message that keeps its memory, utime and sequence.
  void Export(int player, int count, Inputs* to) const;

  /// Saves the known inputs.
  void Persist(StateArchive& a);

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
  /// Returns the newest known input at or before `tick`, or nullptr.
  const Known* Before(std::int64_t tick) const;
  int ButtonsBefore(std::int64_t tick) const;
  void FindNewestChange();

  std::vector<Known> ring_;  // by tick modulo its size; empty: nothing is known
  std::int64_t newest_ = -1, oldest_ = -1;
  std::int64_t newest_change_ = -1;  // tick of the newest known input that differs from the known
                                     // one before it
  std::int64_t presses_taken_until_ = -1;
};

}  // namespace seam
