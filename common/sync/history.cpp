#include "common/sync/history.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <optional>
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
  replaced_.clear();
  newest_ = tick;
  count_ = std::min(count_ + 1, capacity_);
  const int slot = static_cast<int>(tick % capacity_);
  piece_ = slot / kPiece;
  in_piece_ = slot % kPiece;
}

void History::Put(int body, const BodyState& state) {
  SEAM_ASSERT(body >= 0 && body < bodies_ && count_ > 0);
  std::shared_ptr<Piece>& piece = pieces_[static_cast<std::size_t>(body * pieces_each_ + piece_)];
  (*Own(&piece))[static_cast<std::size_t>(in_piece_)] = state;
}

History::Piece* History::Own(std::shared_ptr<Piece>* piece) {
  if (*piece == nullptr) {
    *piece = std::make_shared<Piece>();
  } else if (piece->use_count() > 1) {
    replaced_.push_back(*piece);
    *piece = std::make_shared<Piece>(*replaced_.back());
  } else {
    std::atomic_thread_fence(std::memory_order_acquire);  // whoever saved it has read it
  }
  return piece->get();
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
  const std::shared_ptr<Piece>& piece = pieces_[PieceOf(slot, body)];
  return piece == nullptr ? &kNothing : &(*piece)[static_cast<std::size_t>(slot % kPiece)];
}

BodyState* History::At(std::int64_t tick, int body) {
  SEAM_ASSERT(body >= 0 && body < bodies_);
  if (!Has(tick)) return nullptr;
  const int slot = static_cast<int>(tick % capacity_);
  return &(*Own(&pieces_[PieceOf(slot, body)]))[static_cast<std::size_t>(slot % kPiece)];
}

std::int64_t History::newest() const { return count_ == 0 ? -1 : newest_; }
std::int64_t History::oldest() const { return count_ == 0 ? -1 : newest_ - count_ + 1; }
void History::Clear() { count_ = 0; }

void History::Persist(StateArchive& a, std::int64_t from, const std::function<bool(int)>& still) {
  a.Section("history");
  auto count = static_cast<int>(std::clamp<std::int64_t>(newest_ - from + 1, 0, count_));
  a.Int(&count, 0, capacity_);
  if (a.reading()) count_ = count;
  a.Int(&newest_, -1, StateArchive::kTickMost);
  a.Require(newest_ >= count - 1, "it is of no such tick");
  if (a.reading()) return Load(a);
  std::vector<char> with_ticks(static_cast<std::size_t>(pieces_each_), 0);
  for (std::int64_t tick = newest_ - count + 1; tick <= newest_; ++tick) {
    with_ticks[static_cast<std::size_t>(tick % capacity_ / kPiece)] = 1;
  }
  std::vector<std::optional<BodyState>> poses(static_cast<std::size_t>(bodies_));
  Pieces pieces;  // of the bodies without a pose
  for (int body = 0; body < bodies_; ++body) {
    if (count > 0 && still(body)) {
      poses[static_cast<std::size_t>(body)] = *std::as_const(*this).At(newest_, body);
      continue;
    }
    for (int k = 0; k < pieces_each_; ++k) {
      const bool kept = with_ticks[static_cast<std::size_t>(k)] != 0;
      pieces.push_back(kept ? pieces_[PieceOf(k * kPiece, body)] : nullptr);
    }
  }
  a.Later([poses = std::move(poses), pieces = std::move(pieces),
           each = pieces_each_](StateArchive& out) {
    auto next = pieces.begin();
    for (std::optional<BodyState> pose : poses) {
      bool one = pose.has_value();
      out.Flag(&one);
      if (one) PersistStates(out, &*pose, 1);
      for (int k = 0; !one && k < each; ++k) {
        std::shared_ptr<Piece> piece = *next++;
        PersistPiece(out, &piece);
      }
    }
  });
}

void History::Load(StateArchive& a) {
  for (int body = 0; body < bodies_ && a.ok(); ++body) {
    bool one = false;
    a.Flag(&one);
    for (int k = 0; !one && k < pieces_each_ && a.ok(); ++k) {
      PersistPiece(a, &pieces_[PieceOf(k * kPiece, body)]);
    }
    if (!one) continue;
    BodyState pose;
    PersistStates(a, &pose, 1);
    for (std::int64_t tick = oldest(); count_ > 0 && tick <= newest_; ++tick)
      *At(tick, body) = pose;
  }
  if (count_ == 0) return;
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

void History::PersistPiece(StateArchive& a, std::shared_ptr<Piece>* piece) {
  bool there = *piece != nullptr, one = there && !a.reading() && IsOnePose(**piece);
  a.Flag(&there);
  if (a.reading()) *piece = there ? std::make_shared<Piece>() : nullptr;
  if (!there) return;
  a.Flag(&one);
  PersistStates(a, (*piece)->data(), one ? 1 : kPiece);
  if (a.reading() && one) (*piece)->fill((*piece)->front());
}

void History::TakePast(Pieces* before, int from, int body) {
  for (int slot = 0; slot < capacity_; slot += kPiece) {
    pieces_[PieceOf(slot, body)] = std::move((*before)[PieceOf(slot, from)]);
  }
  for (int k = 1; k <= capacity_ - count_; ++k) {  // recorded before Clear
    const int slot = static_cast<int>((newest_ + k) % capacity_);
    std::shared_ptr<Piece>& piece = pieces_[PieceOf(slot, body)];
    if (piece != nullptr) (*Own(&piece))[static_cast<std::size_t>(slot % kPiece)] = BodyState();
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
      const std::shared_ptr<Piece>& piece = before[PieceOf(slot, origin.body)];
      const auto in_piece = static_cast<std::size_t>(slot % kPiece);
      past = Carried(origin, piece == nullptr ? kNothing : (*piece)[in_piece]);
    }
  }
}

}  // namespace seam
