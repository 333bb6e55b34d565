#include "server/sessions/settled_worlds.h"

#include <algorithm>

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
  if (std::any_of(owed_.begin(), owed_.end(), due)) {
    const std::int64_t until = HeardUntil();
    Bytes world;  // the newest: what is later than one tick is good for an earlier one
    std::vector<Chunk> pieces;
    std::int64_t from = -1;
    for (Owed& owed : owed_) {
      Session* const session = sessions_.Find(owed.peer);
      if (session == nullptr || session->stage != SessionStage::kReady) owed.due = false;
      if (!due(owed)) continue;
      if (world.empty() || owed.from > from) {
        from = owed.from;
        world = replica_.SettledWorld(from, until);
        if (!world.empty()) pieces = ToWorldPieces(world, now_us);
      }
      if (world.empty()) continue;  // not yet
      owed = {owed.peer, owed.news, -1, now_us + kNextWorldUs, owed.news > owed.from};
      SendTo(*session, pieces);
    }
  }
  const auto over = [&](const Owed& owed) { return !owed.due && now_us >= owed.at_us; };
  owed_.erase(std::remove_if(owed_.begin(), owed_.end(), over), owed_.end());
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
