/// Server: who has what, and who is told.

#include <algorithm>

#include "common/sync/lease.h"
#include "server/server.h"

namespace seam {

void Server::UpdateAuthority(std::int64_t now_us) {
  AuthorityManager::Situation situation;
  situation.peer_of_player = sessions_.PeerOfPlayer();
  situation.one_way_s.reserve(situation.peer_of_player.size());
  for (int& peer : situation.peer_of_player) {
    const Session* session = sessions_.Find(peer);
    const std::int64_t rtt_us = session != nullptr ? session->link.rtt_us() : 0;
    const bool silent = session != nullptr && session->stage == SessionStage::kReady &&
                        now_us - session->link.last_receive_us() > kSilentUs;
    if (silent) situation.silent.Add(peer);
    if (session != nullptr && session->lapsed) peer = -1;
    situation.load.push_back(session != nullptr ? session->load : -1.0f);
    situation.one_way_s.push_back(static_cast<float>(std::max<std::int64_t>(0, rtt_us)) * 0.5e-6f);
  }
  situation.together = edits_.WaitingMechanisms();
  const std::vector<Grants> grants = authority_.Update(now_us, situation);
  TellAuthority(now_us, grants);
  UpdateInterest(now_us, !grants.empty());
  broadcast_.TellOwed(now_us);
  const PeerSet withholding = authority_.Withholding(now_us);
  sessions_.ForEachReady(0, [&](Session& session) {
    if (!withholding.Has(session.peer)) return;
    session.leaving = true;
    session.leaving_why = "does not let go";
  });
}

void Server::TellAuthority(std::int64_t now_us, const std::vector<Grants>& grants) {
  for (AuthorityManager::Given& given : authority_.TakeGiven()) {
    given.exact.utime = now_us;
    Session* session = sessions_.Find(given.peer);
    if (session != nullptr) session->link.SendReliable(Encode(given.exact));
  }
  broadcast_.Tell(grants);
}

void Server::UpdateInterest(std::int64_t now_us, bool changed) {
  const int every = std::max(1, config_.sync.tick_hz / Broadcast::kLooksPerSecond);
  const bool due = replica_.tick() % every == 0 || broadcast_.stale();
  if (due) broadcast_.LookAround(now_us);
  if (due || changed) FindHeardPlayers();
}

}  // namespace seam
