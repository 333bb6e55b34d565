#include "server/sessions/settled_worlds.h"

#include <algorithm>
#include <limits>

#include "common/codec/codec.h"
#include "common/sync/inputs/world_pieces.h"

namespace seam {

void SettledWorlds::Owe(int peer) {
  auto owed = std::find_if(owed_.begin(), owed_.end(),
                           [peer](const Owed& each) { return each.peer == peer; });
  if (owed == owed_.end()) owed = owed_.insert(owed_.end(), {peer});
  // A world of before the latest news does not end it, but is sent: news may come every tick.
  (owed->due ? owed->news : owed->from) = replica_.tick();
  owed->due = true;
}

void SettledWorlds::Send(std::int64_t now_us) {
  const auto due = [&](const Owed& owed) { return owed.due && now_us >= owed.at_us; };
  std::int64_t from = std::numeric_limits<std::int64_t>::max();
  for (Owed& owed : owed_) {
    Session* const session = sessions_.Find(owed.peer);
    if (session == nullptr || session->stage != SessionStage::kReady) owed.due = false;
    if (due(owed)) from = std::min(from, owed.from);
  }
  if (from < std::numeric_limits<std::int64_t>::max()) SendSince(now_us, from);
  const auto over = [&](const Owed& owed) { return !owed.due && now_us >= owed.at_us; };
  owed_.erase(std::remove_if(owed_.begin(), owed_.end(), over), owed_.end());
}

/// `from`: the earliest of those that are due.
void SettledWorlds::SendSince(std::int64_t now_us, std::int64_t from) {
  const std::int64_t until = HeardUntil();
  Bytes world = replica_.SettledWorld(from, until);  // the newest, so it may do for all
  if (world.empty()) return;                         // not yet
  std::vector<Chunk> pieces = ToWorldPieces(world, now_us);
  for (Owed& owed : owed_) {
    if (!owed.due || now_us < owed.at_us) continue;
    if (owed.from > from) {
      world = replica_.SettledWorld(owed.from, until);
      if (world.empty()) continue;
      from = owed.from;
    }
    SendTo(*sessions_.Find(owed.peer), pieces);
    owed = {owed.peer, owed.news, -1, now_us + kNextWorldUs, owed.news > owed.from};
  }
}

/// Who is ready again counts as absent until its first input is here; and a client may be a tick or
/// two behind.
std::int64_t SettledWorlds::HeardUntil() const {
  std::int64_t until = replica_.tick() - BarrierEvery(replica_.world().scene().solver.tick_hz);
  sessions_.ForEachReady(0, [&](const Session& session) {
    if (session.player < 0) return;
    until = std::min(until, replica_.inputs(session.player).newest());
  });
  return until;
}

void SettledWorlds::SendTo(Session& session, const std::vector<Chunk>& pieces) {
  std::size_t bytes = 0;
  for (const Chunk& piece : pieces) bytes += piece.data.size();
  if (static_cast<double>(bytes) > session.link.rate().bytes_per_s() / 2) return;
  for (const Chunk& piece : pieces) session.link.SendReliable(Encode(piece));
}

}  // namespace seam
