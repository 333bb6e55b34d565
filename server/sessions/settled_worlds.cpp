#include "server/sessions/settled_worlds.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "common/codec/codec.h"
#include "common/sync/inputs/world_pieces.h"

namespace seam {
namespace {

/// A world is packed at most so often, however many ask for it, us.
constexpr std::int64_t kPackEveryUs = 250000;
/// A player whose inputs have not come for so long is waited for no more, us: as Reach does.
constexpr std::int64_t kInputsLateUs = 1500000;
/// Nor is a world waited for that does not settle for so long, s: the server has no copies.
constexpr std::int64_t kSettlesWithin = 10;

}  // namespace

void SettledWorlds::Owe(int peer) {
  Owed& owed = owed_[peer];
  // A world of before the latest news does not end it, but is sent: news may come every tick.
  (owed.due ? owed.news : owed.from) = replica_.tick();
  owed.due = true;
}

void SettledWorlds::Send(std::int64_t now_us) {
  const std::int64_t oldest =
      replica_.tick() - kSettlesWithin * replica_.world().scene().solver.tick_hz;
  std::optional<std::int64_t> until;  // looked for once
  for (auto next = owed_.begin(); next != owed_.end();) {
    Owed& owed = next->second;
    Session* const session = sessions_.Find(next->first);
    const bool ready = session != nullptr && session->stage == SessionStage::kReady;
    owed.due = owed.due && ready && owed.from >= oldest;
    if (owed.due && now_us >= owed.at_us) {
      if (!until) until = HeardUntil(now_us);
      if (Pack(now_us, owed.from, *until)) {
        SendTo(*session);
        owed = {owed.news, -1, now_us + kNextWorldUs, owed.news > owed.from};
      }
    }
    next = !owed.due && now_us >= owed.at_us ? owed_.erase(next) : std::next(next);
  }
}

bool SettledWorlds::Pack(std::int64_t now_us, std::int64_t from, std::int64_t until) {
  if (packed_from_ >= from && now_us - packed_us_ < kPackEveryUs) return true;
  const Bytes world = replica_.SettledWorld(from, until);
  if (world.empty()) return false;
  packed_from_ = from;
  pieces_ = ToWorldPieces(world, now_us);
  packed_us_ = now_us;
  return true;
}

/// Who is ready again counts as absent until its first input is here; and a client may be a tick or
/// two behind.
std::int64_t SettledWorlds::HeardUntil(std::int64_t now_us) {
  const int hz = replica_.world().scene().solver.tick_hz;
  const std::int64_t late = replica_.tick() - kInputsLateUs * hz / 1000000;
  std::int64_t until = replica_.tick() - BarrierEvery(hz);
  sessions_.ForEachReady(0, [&](const Session& session) {
    if (session.player < 0 || session.leaving || session.lapsed) return;
    const std::int64_t newest = replica_.inputs(session.player).newest();
    if (newest < late && now_us - session.account->returned_us > kInputsLateUs) return;
    until = std::min(until, newest);
  });
  return until;
}

void SettledWorlds::SendTo(Session& session) {
  std::size_t bytes = 0;
  for (const Chunk& piece : pieces_) bytes += piece.data.size();
  if (static_cast<double>(bytes) > session.link.rate().bytes_per_s() / 4) return;
  for (const Chunk& piece : pieces_) session.link.SendReliable(Encode(piece));
}

}  // namespace seam
