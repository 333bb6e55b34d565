#pragma once
/// Recent states of a world's bodies, by tick, for retrospective corrections.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "common/scene/types.h"
#include "common/sync/table/body_table.h"

namespace seam {

class StateArchive;

/// A ring of the last `capacity` ticks. Ticks are recorded one after another. After an edit each
/// body has the past of the body that it came from, moved rigidly; the past of a new body is filled
/// with its state then.
class History final : public TableEntry {
 public:
  /// `now` returns the current state of a body; called at edits.
  History(const BodyTable& table, int capacity_ticks, std::function<BodyState(int)> now);

  /// Records all bodies' states after `tick`. Requires tick == newest() + 1, or empty and tick >=
  /// 0; use Clear before a jump.
  void Record(std::int64_t tick, const std::vector<BodyState>& states);
  /// Begins a tick without states: until one is written, At(tick, body) returns an obsolete state.
  /// Requires the same as Record.
  void Begin(std::int64_t tick);
  /// Stores a body's state after the newest tick. Requires that there is a newest tick.
  void Put(int body, const BodyState& state);
  /// Returns nullptr if the tick is not in the ring.
  const BodyState* At(std::int64_t tick, int body) const;
  BodyState* At(std::int64_t tick, int body);
  std::int64_t newest() const;  ///< -1 when empty
  std::int64_t oldest() const;  ///< -1 when empty
  void Clear();
  /// Saves the ring from tick `from` on, or loads it. `still(body)`: true if the body has one pose
  /// at all its ticks. Reading requires a history of the same capacity and bodies. Writing copies
  /// nothing: it keeps what is there now, and its bytes are made by StateDraft::Finish.
  void Persist(StateArchive& a, std::int64_t from, const std::function<bool(int)>& still);

 private:
  // A body's ticks lie together, in pieces that are allocated at the first write: in a large room
  // most bodies are never accessed, and the cost of a tick is the memory that it touches.
  static constexpr int kPiece = 12;  // ticks
  using Piece = std::array<BodyState, kPiece>;
  /// A piece that is being saved has two owners; who changes it changes a copy.
  using Pieces = std::vector<std::shared_ptr<Piece>>;
  bool Has(std::int64_t tick) const {
    return count_ > 0 && tick <= newest_ && tick > newest_ - count_;
  }
  std::size_t PieceOf(int slot, int body) const {
    return static_cast<std::size_t>(body * pieces_each_ + slot / kPiece);
  }

  void Renumber(const BodyRemap& change) override;
  /// Returns the piece for a change: made if it is not there, copied if it is being saved.
  Piece* Own(std::shared_ptr<Piece>* piece);
  static bool IsOnePose(const Piece& piece);
  static void PersistPiece(StateArchive& a, std::shared_ptr<Piece>* piece);
  void Load(StateArchive& a);
  /// Moves the past of an unchanged body to its new number.
  void TakePast(Pieces* before, int from, int body);

  const std::function<BodyState(int)> now_;
  const int capacity_;
  const int pieces_each_;  // per body
  int bodies_ = 0;
  int count_ = 0;
  std::int64_t newest_ = -1;
  int piece_ = 0, in_piece_ = 0;  // position of the newest tick, of each body
  Pieces pieces_;
  Pieces replaced_;  // in this tick, by copies: readers may still look at them
};

}  // namespace seam
