/// Server, incoming messages: every byte is distrusted; bad ones are dropped and counted by reason.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "server/authority_source.h"
#include "server/chronicle.h"
#include "server/input_room.h"
#include "server/server.h"

namespace seam {
namespace {

/// Most proposals that wait; a hostile peer must not fill the memory.
constexpr std::size_t kWaitingBreaksMax = 1024;

}  // namespace

void Server::ReceiveAll(std::int64_t now_us) {
  Stats& stats = stats_.counters;
  Address from;
  Bytes datagram;
  for (int n = 0; n < kDatagramsMax && net_.Receive(&from, &datagram); ++n) {
    stats.bytes_in += static_cast<std::int64_t>(datagram.size());
    stats.datagrams_in += 1;
    const auto verdict = sessions_.Receive(
        now_us, from, datagram,
        [&](Session& session, ByteView message) { Deliver(now_us, session, message); });
    if (verdict == SessionTable::Verdict::kMalformed) ++stats.dropped_malformed;
    if (verdict == SessionTable::Verdict::kNoRight) ++stats.dropped_right;
    if (verdict == SessionTable::Verdict::kOverBudget) ++stats.dropped_budget;
    FollowSessions(now_us);
  }
  stats_.NoteDiscarded(net_.discarded());
}

void Server::Deliver(std::int64_t now_us, Session& session, ByteView bytes) {
  const DropCount before = DropsOf(stats_.counters);
  OnMessage(now_us, session, bytes);
  AddDrops(stats_.counters, before, &session.account->dropped);
}

void Server::OnMessage(std::int64_t now_us, Session& session, ByteView bytes) {
  if (!session.kinds.Take(now_us, bytes)) {
    ++stats_.counters.dropped_budget;
    return;
  }
  ++stats_.decoded;
  const AnyMessage any = Decode(bytes);
  if (const auto* packed = std::get_if<PackedStates>(&any)) {
    OnPacked(now_us, session, *packed);
  } else if (const auto* packed_inputs = std::get_if<PackedInputs>(&any)) {
    OnPacked(now_us, session, *packed_inputs);
  } else if (const auto* states = std::get_if<States>(&any)) {
    OnStates(now_us, session, *states);
  } else if (const auto* inputs = std::get_if<Inputs>(&any)) {
    OnInputs(now_us, session, *inputs);
  } else if (const auto* differing = std::get_if<Differing>(&any)) {
    OnDiffering(session, *differing);
  } else if (const auto* reset = std::get_if<Reset>(&any)) {
    session.packer.Reset(static_cast<std::uint16_t>(reset->number));
  } else if (const auto* ping = std::get_if<Ping>(&any)) {
    OnPing(now_us, session, *ping);
  } else if (const auto* rest = std::get_if<Rest>(&any)) {
    OnRest(now_us, session, *rest);
  } else if (const auto* exact = std::get_if<ExactStates>(&any)) {
    OnExactStates(now_us, session, *exact);
  } else if (const auto* release = std::get_if<Release>(&any)) {
    OnRelease(now_us, session, *release);
  } else if (const auto* report = std::get_if<ImpactReport>(&any)) {
    OnReport(now_us, session, *report);
  } else if (const auto* touches = std::get_if<TouchReport>(&any)) {
    OnReport(now_us, session, *touches);
  } else if (const auto* proposal = std::get_if<EditOrder>(&any)) {
    OnProposal(session, *proposal);
  } else if (std::holds_alternative<Ready>(any)) {
    sessions_.NoteReady(session);
    session.account->returned_us = now_us;
    FollowSessions(now_us);
  } else if (std::holds_alternative<Hello>(any)) {
    OnHello(now_us, session);
  } else if (std::holds_alternative<Bye>(any)) {
    session.goodbye = true;
    sessions_.Leave(session, "left");
  } else {
    ++stats_.counters.dropped_malformed;
  }
}

void Server::OnHello(std::int64_t now_us, Session& session) {
  Bye bye;
  bye.utime = now_us;
  bye.reason = sessions_.FreeNames(now_us);
  session.link.SendReliable(Encode(bye));
}

void Server::OnPing(std::int64_t now_us, Session& session, const Ping& ping) {
  Pong pong;
  pong.utime = now_us;
  pong.client_us = ping.utime;
  pong.tick0_us = clock_.Tick0Us(now_us);
  pong.speed_ppm = clock_.speed_ppm();
  LookAtRest(now_us, session, ping, &pong);
  session.load = static_cast<float>(ping.load) * 1e-3f;
  session.revision = ping.revision;
  if (session.ending_us < 0) session.link.SendUnreliable(Encode(pong));
  const bool more = session.link.reliable_pending();
  if (session.stage != SessionStage::kReady) return;
  if (input_room_ != nullptr) return FindParted(now_us, session, ping);
  if (!edits_->NeedsRepair(ping, more)) return;
  // Not again too soon: the messages of the last repair must arrive first.
  if (now_us - session.repaired_us < kRepairAgainUs) return;
  session.repaired_us = now_us;
  Event event = MakeEvent(EventKind::kRepaired,
                          session.name + " (peer " + std::to_string(session.peer) +
                              ") has another composition after " + std::to_string(ping.revision) +
                              " edits: repaired",
                          session.player);
  event.client = session.peer;
  chronicle_->Say(now_us, event);
  ++stats_.connections.compositions;
  session.link.SendReliable(Encode(edits_->BeginAnew(now_us)));
  SendWorld(now_us, session);
}

void Server::LookAtRest(std::int64_t now_us, Session& session, const Ping& ping, Pong* pong) {
  const RestCommit& rest = replica_.rest();
  pong->rest = static_cast<std::int64_t>(rest.Hash());
  session.rest_agrees = pong->rest == ping.rest;
  const bool same_bodies =
      ping.revision == replica_.revision() &&
      ping.composition == static_cast<std::int64_t>(replica_.world().composition().hash);
  const RestBlock at{ping.rest_blocks, ping.rest_block};
  if (session.stage != SessionStage::kReady || at.blocks == 0 || !same_bodies) return;
  pong->rest_blocks = ping.rest_blocks;
  pong->rest_block = ping.rest_block;
  pong->rest_own = static_cast<std::int32_t>(rest.HashOf(at, session.peer));
  if (broadcast_.RestIsPendingFor(session.peer, at)) {
    session.rest.Skip(at);
  } else if (session.rest.Lost(now_us, session.link.SentUntilUs(now_us), at, rest.HashOf(at, -1),
                               static_cast<std::uint32_t>(ping.rest_part))) {
    ++stats_.connections.rests;
    for (Rest& again : replica_.rest().Again(at, -1)) {
      again.utime = now_us;
      session.link.SendReliable(Encode(again));
    }
  }
}

void Server::OnRelease(std::int64_t now_us, Session& session, const Release& release) {
  for (std::size_t i = 0; i < release.mechanism.size(); ++i) {
    if (authority_.HoldsInEpoch(session.peer, release.mechanism[i], release.epoch[i])) {
      session.lapsed = true;
      broadcast_.Tell(authority_.TakeBack(now_us, session.peer));
      NoteAuthority(now_us);
      return;
    }
    switch (authority_.AcceptRelease(session.peer, release.mechanism[i], release.epoch[i])) {
      case AuthorityManager::Right::kYes: break;
      case AuthorityManager::Right::kStale: ++stats_.counters.dropped_stale; break;
      case AuthorityManager::Right::kNo: ++stats_.counters.dropped_right; break;
    }
  }
}

template <class Report>
void Server::OnReport(std::int64_t now_us, const Session& session, const Report& report) {
  if (session.stage != SessionStage::kReady || rule_source_ == nullptr || InputsOnly(session)) {
    ++stats_.counters.dropped_right;
    return;
  }
  broadcast_.NoteAccepted(now_us, session.peer, session.player, report);
  rule_source_->NoteReport(session.peer, report);
}

void Server::OnProposal(Session& session, const EditOrder& proposal) {
  Stats& stats = stats_.counters;
  if (session.stage != SessionStage::kReady || proposal.number != -1 || InputsOnly(session)) {
    ++stats.dropped_right;
    return;
  }
  if (NeedsLoad(proposal) && waiting_breaks_.size() < kWaitingBreaksMax) {
    waiting_breaks_.push_back({session.peer, replica_.tick(), proposal});
    return;
  }
  Propose(session, proposal);
}

void Server::Propose(Session& session, const EditOrder& proposal) {
  Stats& stats = stats_.counters;
  switch (edits_->Propose(session.peer, proposal)) {
    case EditLog::Verdict::kTaken: break;
    case EditLog::Verdict::kStale: ++stats.dropped_stale; break;
    case EditLog::Verdict::kNoRight: ++stats.dropped_right; break;
    case EditLog::Verdict::kTooMany:
    case EditLog::Verdict::kImplausible: ++stats.dropped_implausible; break;
  }
}

}  // namespace seam
