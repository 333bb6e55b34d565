#include "common/physics/history.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"

namespace seam {

History::History(int body_count, int capacity_ticks)
    : bodies_(body_count),
      capacity_(capacity_ticks),
      pieces_each_((capacity_ticks + kPiece - 1) / kPiece),
      pieces_(static_cast<std::size_t>(body_count) * static_cast<std::size_t>(pieces_each_)) {
  SEAM_ASSERT(body_count >= 0 && capacity_ticks > 0);
}

void History::Begin(std::int64_t tick) {
  SEAM_ASSERT(tick >= 0 && (count_ == 0 || tick == newest_ + 1));
  newest_ = tick;
  count_ = std::min(count_ + 1, capacity_);
  const int slot = static_cast<int>(tick % capacity_);
  piece_ = slot / kPiece;
  in_piece_ = slot % kPiece;
}

void History::Put(int body, const BodyState& state) {
  SEAM_ASSERT(body >= 0 && body < bodies_ && count_ > 0);
  std::unique_ptr<Piece>& piece = pieces_[static_cast<std::size_t>(body * pieces_each_ + piece_)];
  if (piece == nullptr) piece = std::make_unique<Piece>();
  (*piece)[static_cast<std::size_t>(in_piece_)] = state;
}

void History::Record(std::int64_t tick, const std::vector<BodyState>& states) {
  SEAM_ASSERT(static_cast<int>(states.size()) == bodies_);
  Begin(tick);
  for (int body = 0; body < bodies_; ++body) {
    Put(body, states[static_cast<std::size_t>(body)]);
  }
}

const BodyState* History::At(std::int64_t tick, int body) const {
  SEAM_ASSERT(body >= 0 && body < bodies_);
  static const BodyState kNothing;
  if (!Has(tick)) return nullptr;
  const int slot = static_cast<int>(tick % capacity_);
  const std::unique_ptr<Piece>& piece = pieces_[PieceOf(slot, body)];
  return piece == nullptr ? &kNothing : &(*piece)[static_cast<std::size_t>(slot % kPiece)];
}

BodyState* History::At(std::int64_t tick, int body) {
  SEAM_ASSERT(body >= 0 && body < bodies_);
  if (!Has(tick)) return nullptr;
  const int slot = static_cast<int>(tick % capacity_);
  std::unique_ptr<Piece>& piece = pieces_[PieceOf(slot, body)];
  if (piece == nullptr) piece = std::make_unique<Piece>();
  return &(*piece)[static_cast<std::size_t>(slot % kPiece)];
}

std::int64_t History::newest() const { return count_ == 0 ? -1 : newest_; }
std::int64_t History::oldest() const { return count_ == 0 ? -1 : newest_ - count_ + 1; }
void History::Clear() { count_ = 0; }

void History::Remap(const std::vector<BodyOrigin>& origins, const std::vector<BodyState>& now) {
  SEAM_ASSERT(origins.size() == now.size());
  History then(static_cast<int>(origins.size()), capacity_);
  std::swap(*this, then);
  count_ = then.count_;
  newest_ = then.newest_;
  piece_ = then.piece_;
  in_piece_ = then.in_piece_;
  for (std::int64_t tick = oldest(); count_ > 0 && tick <= newest_; ++tick) {
    for (int body = 0; body < bodies_; ++body) {
      const BodyOrigin& origin = origins[static_cast<std::size_t>(body)];
      *At(tick, body) = origin.body < 0 ? now[static_cast<std::size_t>(body)]
                                        : Carried(origin, *then.At(tick, origin.body));
    }
  }
}

}  // namespace seam
