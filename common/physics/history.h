#pragma once
/// The recent past of a world's bodies, tick by tick: what retrospective corrections look at.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/scene/types.h"
#include "common/topology/body_remap.h"

namespace seam {

/// A ring of the last `capacity` ticks. Ticks are recorded one after another.
class History {
 public:
  History(int body_count, int capacity_ticks);

  /// Notes all bodies' states after `tick`. Requires tick == newest() + 1, or empty and tick >= 0;
  /// use Clear before a jump.
  void Record(std::int64_t tick, const std::vector<BodyState>& states);
  /// Begins a tick of which no body's state is noted yet: At(tick, body) is what it was long ago
  /// until it is written. Requires the same.
  void Begin(std::int64_t tick);
  /// Notes a body's state after the newest tick. Requires that there is one.
  void Put(int body, const BodyState& state);
  /// nullptr when the tick is not in the ring.
  const BodyState* At(std::int64_t tick, int body) const;
  BodyState* At(std::int64_t tick, int body);
  std::int64_t newest() const;  ///< -1 when empty
  std::int64_t oldest() const;  ///< -1 when empty
  void Clear();
  /// The bodies have changed: each one's past is that of where it came from, moved rigidly; of
  /// what is new there is none, and `now` is taken instead.
  void Remap(const std::vector<BodyOrigin>& origins, const std::vector<BodyState>& now);

 private:
  // A body's ticks lie together, in pieces that are made when something is first noted in them: in
  // a large room most bodies are never looked at, and what a tick costs is the memory that it is
  // in.
  static constexpr int kPiece = 12;  // ticks
  using Piece = std::array<BodyState, kPiece>;
  bool Has(std::int64_t tick) const {
    return count_ > 0 && tick <= newest_ && tick > newest_ - count_;
  }
  std::size_t PieceOf(int slot, int body) const {
    return static_cast<std::size_t>(body * pieces_each_ + slot / kPiece);
  }

  int bodies_ = 0;
  int capacity_ = 0;
  int pieces_each_ = 0;  // of a body
  int count_ = 0;
  std::int64_t newest_ = -1;
  int piece_ = 0, in_piece_ = 0;  // where the newest tick is, of each body
  std::vector<std::unique_ptr<Piece>> pieces_;
};

}  // namespace seam
