#include "common/sync/history.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "common/base/check.h"
#include "common/scene/saved/persist_state.h"

namespace seam {

History::History(const BodyTable& table, int capacity_ticks, std::function<BodyState(int)> now)
    : TableEntry(table),
      now_(std::move(now)),
      capacity_(capacity_ticks),
      pieces_each_((capacity_ticks + kPiece - 1) / kPiece),
      bodies_(table.bodies()),
      pieces_(PieceOf(0, bodies_)) {
  SEAM_ASSERT(capacity_ticks > 0);
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

void History::Persist(StateArchive& a, const std::function<bool(int)>& still) {
  a.Section("history");
  a.Int(&count_, 0, capacity_);
  a.Int(&newest_, -1, StateArchive::kTickMost);
  a.Require(newest_ >= count_ - 1, "it is of no such tick");
  for (int body = 0; body < bodies_ && a.ok(); ++body) {
    bool one = !a.reading() && count_ > 0 && still(body);
    a.Flag(&one);
    if (!one) {
      PersistPieces(a, body);
      continue;
    }
    BodyState pose = a.reading() ? BodyState() : *std::as_const(*this).At(newest_, body);
    PersistStates(a, &pose, 1);
    if (!a.reading()) continue;
    for (std::int64_t tick = oldest(); tick <= newest_; ++tick) *At(tick, body) = pose;
  }
  if (!a.reading() || count_ == 0) return;
  const int slot = static_cast<int>(newest_ % capacity_);
  piece_ = slot / kPiece;
  in_piece_ = slot % kPiece;
}

bool History::IsOnePose(const Piece& piece) {
  const auto as_first = [&](const BodyState& state) {
    return std::memcmp(&state, &piece.front(), sizeof state) == 0;
  };
  return std::all_of(piece.begin(), piece.end(), as_first);
}

void History::PersistPieces(StateArchive& a, int body) {
  for (int slot = 0; slot < capacity_ && a.ok(); slot += kPiece) {
    std::unique_ptr<Piece>& piece = pieces_[PieceOf(slot, body)];
    bool there = piece != nullptr, one = there && !a.reading() && IsOnePose(*piece);
    a.Flag(&there);
    if (a.reading()) piece = there ? std::make_unique<Piece>() : nullptr;
    if (!there) continue;
    a.Flag(&one);
    PersistStates(a, piece->data(), one ? 1 : piece->size());
    if (one) piece->fill(piece->front());
  }
}

void History::TakePast(Pieces* before, int from, int body) {
  for (int slot = 0; slot < capacity_; slot += kPiece) {
    pieces_[PieceOf(slot, body)] = std::move((*before)[PieceOf(slot, from)]);
  }
  for (int k = 1; k <= capacity_ - count_; ++k) {  // recorded before Clear
    const int slot = static_cast<int>((newest_ + k) % capacity_);
    const std::unique_ptr<Piece>& piece = pieces_[PieceOf(slot, body)];
    if (piece != nullptr) (*piece)[static_cast<std::size_t>(slot % kPiece)] = BodyState();
  }
}

void History::Renumber(const BodyRemap& change) {
  static const BodyState kNothing;
  Pieces before(change.bodies.size() * static_cast<std::size_t>(pieces_each_));
  before.swap(pieces_);
  bodies_ = static_cast<int>(change.bodies.size());
  for (int body = 0; body < bodies_; ++body) {
    const BodyOrigin& origin = change.bodies[static_cast<std::size_t>(body)];
    if (origin.same) {
      TakePast(&before, origin.body, body);
      continue;
    }
    const BodyState now = origin.body < 0 ? now_(body) : BodyState();
    for (std::int64_t tick = oldest(); count_ > 0 && tick <= newest_; ++tick) {
      BodyState& past = *At(tick, body);
      past = now;
      if (origin.body < 0) continue;
      const int slot = static_cast<int>(tick % capacity_);
      const std::unique_ptr<Piece>& piece = before[PieceOf(slot, origin.body)];
      const auto in_piece = static_cast<std::size_t>(slot % kPiece);
      past = Carried(origin, piece == nullptr ? kNothing : (*piece)[in_piece]);
    }
  }
}

}  // namespace seam
