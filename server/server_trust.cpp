/// Server: states that wait for its own copies, and consequences of doubts (docs/trust.md).

#include <algorithm>
#include <utility>

#include "common/net/keyed_hash.h"
#include "common/stages/make_stages.h"
#include "common/sync/edits/edit_order.h"
#include "common/topology/grip.h"
#include "server/chronicle.h"
#include "server/server.h"
#include "server/trust/auditor.h"

namespace seam {
namespace {

/// Longest wait of a client's states for the server's copies of their tick, s: until the inputs of
/// that tick are known and acted on. Longer delays honest states where another player is silent.
constexpr double kCopyWaitS = 0.2;
/// Longest wait of a proposed break for its load in the server's own world, s; and its weight in
/// the ladder, if none was felt.
constexpr double kLoadWaitS = 0.5;
constexpr float kLoadlessWeight = 2;
/// Time after a client came, or came back from a silence, in which no refused state is scored, us:
/// copies part meanwhile, of what others' bodies met too.
constexpr std::int64_t kReturnUs = TrustLadder::kReturnS * 1000000;

std::vector<float> NumbersOf(const BodyState& state) {
  return {state.position.x(), state.position.y(), state.velocity.x(), state.velocity.y()};
}

std::int32_t Milli(float score) { return static_cast<std::int32_t>(1000 * score); }

}  // namespace

void Server::TakeWaitingStates(std::int64_t now_us) {
  PeerSet still;
  const auto most = static_cast<std::int64_t>(kCopyWaitS * scene_.solver.tick_hz);
  for (WaitingStates& waiting : std::exchange(waiting_states_, {})) {
    Session* const session = sessions_.Find(waiting.peer);
    if (session == nullptr || session->stage != SessionStage::kReady) continue;
    const bool may_wait = replica_.tick() - waiting.since < most;
    if (may_wait && (still.Has(waiting.peer) || filter_.Waits(waiting.states))) {
      still.Add(waiting.peer);
      waiting_states_.push_back(std::move(waiting));
      continue;
    }
    const DropCount before = DropsOf(stats_.counters);
    TakeStates(now_us, *session, waiting.states);
    AddDrops(stats_.counters, before, &session->account->dropped);
  }
}

bool Server::NeedsLoad(const EditOrder& proposal) const {
  if (config_.trust != TrustMode::kAct || !ProposesEdits(scene_)) return false;
  const Edit edit = ToEdit(proposal);
  const BreakEdit* const broken = edit.As<BreakEdit>();
  const Topology& topology = replica_.world().topology();
  if (broken == nullptr || !topology.HasJoint(broken->joint)) return false;
  const Joint& joint = topology.scene().joints[static_cast<std::size_t>(broken->joint)];
  return joint.kind == JointKind::kGlue && joint.strength > 0 && !joint.grouped && !IsGrip(joint);
}

/// Where copies agree, the server's own world feels the load that the holder's did.
bool Server::BoreLoad(const EditOrder& proposal) {
  const Edit edit = ToEdit(proposal);
  const std::int32_t joint = edit.As<BreakEdit>()->joint;
  const Topology& topology = replica_.world().topology();
  if (!topology.HasJoint(joint)) return true;  // a stale proposal
  if (config_.sync.policy->GoesBack(0)) return replica_.FeltBreak(joint, proposal.tick);
  return filter_.MayBreak(topology.scene().joints[static_cast<std::size_t>(joint)]);
}

bool Server::Doubted(int player) const {
  if (config_.trust != TrustMode::kAct) return false;
  const std::vector<int>& own = replica_.drivers().MechanismsOf(player);
  for (int body = 0; body < replica_.world().body_count(); ++body) {
    if (!filter_.plausible().OnProbation(body)) continue;
    const int m = replica_.world().mechanism(body);
    if (std::find(own.begin(), own.end(), m) != own.end()) return true;
  }
  return false;
}

void Server::TakeWaitingBreaks(std::int64_t now_us) {
  const auto most = static_cast<std::int64_t>(kLoadWaitS * scene_.solver.tick_hz);
  for (WaitingBreak& waiting : std::exchange(waiting_breaks_, {})) {
    Session* const session = sessions_.Find(waiting.peer);
    if (session == nullptr || session->stage != SessionStage::kReady) continue;
    const DropCount before = DropsOf(stats_.counters);
    if (BoreLoad(waiting.proposal)) {
      Propose(*session, waiting.proposal);
    } else if (replica_.tick() - waiting.since < most) {
      waiting_breaks_.push_back(std::move(waiting));
    } else {
      ++stats_.counters.dropped_implausible;
      ++stats_.connections.loadless;
      const int player = session->player;
      if (player >= 0 && !Excused(now_us, player, DoubtKind::kRefused))
        ladder_.Note(player, kLoadlessWeight);
    }
    AddDrops(stats_.counters, before, &session->account->dropped);
  }
}

void Server::FollowDoubts(std::int64_t now_us, const Session& session) {
  const std::vector<Doubt> doubts = filter_.TakeDoubts();
  if (doubts.empty() || session.player < 0) return;
  // The bodies of a message are often those of one mechanism: one lie, not many.
  const Doubt& gravest =
      *std::max_element(doubts.begin(), doubts.end(),
                        [](const Doubt& a, const Doubt& b) { return a.weight < b.weight; });
  NoteDoubt(now_us, session.peer, session.player, gravest);
}

/// A client cannot make the silence of another, which makes its copies differ; its own it can, so
/// that it excuses only so often, and nothing small. No silence makes gains in its own states.
bool Server::Excused(std::int64_t now_us, int player, DoubtKind kind) {
  if (kind == DoubtKind::kGain) return false;
  const std::vector<int> returned = sessions_.Returned(now_us, kReturnUs);
  const auto own = std::count(returned.begin(), returned.end(), player);
  const bool others = static_cast<std::ptrdiff_t>(returned.size()) > own;
  if (others && kind != DoubtKind::kLeftOut) return true;
  return own > 0 && kind != DoubtKind::kSmall && ladder_.Excuse(player, replica_.tick());
}

void Server::NoteDoubt(std::int64_t now_us, int peer, int player, const Doubt& doubt) {
  ++stats_.connections.doubts;
  const bool refused = doubt.kind == DoubtKind::kRefused;
  // What follows from a silence goes on until the server has the player's bodies.
  const bool parted = ladder_.Withholds(player, replica_.tick());
  const bool excused = doubt.guessed || Excused(now_us, player, doubt.kind);
  if (!excused && !parted) {
    ladder_.Note(player, doubt.weight);
  } else if (refused && config_.trust == TrustMode::kAct) {
    ladder_.NoteParted(player, replica_.tick());
  }
  Audit audit;
  audit.utime = now_us;
  audit.session = room_.session;
  audit.tick = std::max<std::int64_t>(0, doubt.tick);
  audit.peer = peer;
  audit.player = player;
  audit.body = replica_.world().id(doubt.body);
  audit.told = NumbersOf(doubt.told);
  audit.expected = NumbersOf(doubt.expected);
  audit.refused = refused ? 1 : 0;
  audit.score_milli = Milli(ladder_.score(player));
  audit.step = static_cast<std::int8_t>(ladder_.step(player));
  broadcast_.Publish(audit);
}

/// The seed is as secret as the server's lasting key, and another one in each session.
std::unique_ptr<Auditor> Server::MakeAuditor() const {
  if (config_.trust == TrustMode::kOff || !config_.sync.policy->PlansAuthority()) return nullptr;
  HashKey key{};
  std::copy_n(sessions_.keys()->secret.data(), key.size(), key.begin());
  const std::string session = "audit " + std::to_string(room_.session);
  return std::make_unique<Auditor>(replica_, KeyedHash(key, TextBytes(session)));
}

void Server::RunAudit(std::int64_t now_us) {
  if (auditor_ == nullptr || now_us >= next_tick_us()) return;
  auditor_->Work();
  for (const Auditor::Found& found : auditor_->TakeFound()) {
    NoteDoubt(now_us, found.peer, found.player, found.doubt);
  }
}

void Server::FollowLadder(std::int64_t now_us) {
  if (config_.trust == TrustMode::kOff) return;
  for (const TrustLadder::Change& change : ladder_.Update(replica_.tick())) {
    const auto distrusted = [](TrustStep step) { return step >= TrustStep::kServerHolds ? 1 : 0; };
    stats_.connections.distrusted += distrusted(change.to) - distrusted(change.from);
    const std::string& name = scene_.players[static_cast<std::size_t>(change.player)].name;
    std::string line = "trust: " + name + " is " + ToString(change.to);
    if (config_.trust == TrustMode::kWatch) line += " (only watched)";
    const int peer = sessions_.PeerOfPlayer()[static_cast<std::size_t>(change.player)];
    Event event = MakeEvent(EventKind::kTrust, line, change.player);
    event.client = peer;
    event.value_milli = 1000 * static_cast<int>(change.to);
    chronicle_->Say(now_us, event);
    Audit audit;
    audit.utime = now_us;
    audit.session = room_.session;
    audit.tick = replica_.tick();
    audit.peer = std::max(0, peer);
    audit.player = change.player;
    audit.score_milli = Milli(ladder_.score(change.player));
    audit.step = static_cast<std::int8_t>(change.to);
    broadcast_.Publish(audit);
    const bool grave = std::max(change.from, change.to) >= TrustStep::kServerHolds;
    if (grave) Tell(line);
    Session* const session = peer > 0 ? sessions_.Find(peer) : nullptr;
    const bool out = change.to == TrustStep::kOut && config_.trust == TrustMode::kAct;
    if (out && session != nullptr) sessions_.Leave(*session, "its states are not believed");
  }
}

bool Server::MayHold(int player) const {
  if (player < 0) return true;
  return config_.trust == TrustMode::kAct ? ladder_.MayHold(player, replica_.tick())
                                          : !ladder_.Withholds(player, replica_.tick());
}

bool Server::InputsOnly(const Session& session) const {
  return config_.trust == TrustMode::kAct && session.player >= 0 &&
         ladder_.InputsOnly(session.player);
}

}  // namespace seam
