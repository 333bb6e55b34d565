#include "server/server.h"

#include <algorithm>
#include <limits>

#include "common/sync/lease.h"
#include "common/sync/method.h"
#include "server/authority_source.h"
#include "server/chronicle.h"
#include "server/console.h"
#include "server/input_room.h"
#include "server/room_state.h"
#include "server/rules/rules.h"
#include "server/server_commands.h"
#include "server/trust/auditor.h"

namespace seam {
namespace {

/// Most ticks stepped in one call: a server that catches up answers its clients in between.
constexpr int kStepsMax = 2;
/// Time between two lines to those who wait for the start, us; clients started together join in it.
constexpr std::int64_t kTellWaitingUs = 800000;
constexpr float kLetFallRadius = 0.5f;  // m, of the blast that lets hanging bricks fall

Room MakeRoom(const Scene& scene, const ServerConfig& config, Entropy& entropy) {
  Room room;
  while (room.session == 0) room.session = static_cast<std::int64_t>(entropy.Next());
  room.room = config.room;
  room.scene_name = scene.name;
  room.scene_text = scene.text;
  const MethodNames names = NamesOf(config.sync);
  room.mode = names.mode;
  room.reconcile = names.reconcile;
  room.predict = names.predict;
  room.impair = config.impair;
  room.seed = config.seed;
  room.tick_hz = config.sync.tick_hz;
  room.send_hz = config.sync.send_hz;
  room.input_delay_ticks = config.sync.input_delay_ticks;
  return room;
}

/// Settings of the server's own world: without receivers of its views there is no smoothing.
SyncConfig OwnSync(const ServerConfig& config, const Recorder& recorder) {
  SyncConfig sync = config.sync;
  if (config.publish == Publish::kNone || !recorder.listening()) sync.smooth_rate = 0;
  return sync;
}

template <class Message>
Message At(std::int64_t now_us, Message message) {
  message.utime = now_us;
  return message;
}

}  // namespace

Server::Server(const Scene& scene, const ServerConfig& config, Net& net, Recorder& recorder,
               Entropy& entropy)
    : Server(scene, Topology(scene), config, net, recorder, entropy) {}

Server::Server(const SavedRoom& saved, const ServerConfig& config, Net& net, Recorder& recorder,
               Entropy& entropy)
    : Server(saved.scene(), saved.topology(), config, net, recorder, entropy) {}

Server::Server(const Scene& scene, const Topology& topology, const ServerConfig& config, Net& net,
               Recorder& recorder, Entropy& entropy)
    : scene_(scene),
      config_(config),
      room_(MakeRoom(scene_, config_, entropy)),
      epoch_(config.epoch),
      net_(net),
      replica_(topology, OwnSync(config, recorder), 0, -1),
      sessions_(scene_, Encode(room_), AllowedTraffic(config.sync.tick_hz, config.sync.send_hz),
                net, entropy, config.client_bytes_per_s, config.identity,
                TokenDoor{config.token_key, config.room, config.epoch}),
      authority_(scene_, config.sync, replica_),
      edits_(MakeEditLog(*config.sync.policy, replica_.world(), authority_, config.sync.tick_hz)),
      settings_(scene_, config_.sync),
      bounds_(replica_),
      filter_(scene_, replica_, authority_, *edits_, config.trust, stats_.counters),
      ladder_(scene_.players.size(), config.sync.tick_hz),
      broadcast_(recorder, room_, config.publish != Publish::kNone, config.sync, scene_, replica_,
                 sessions_),
      chronicle_(std::make_unique<Chronicle>(room_, replica_, sessions_, broadcast_)),
      room_feed_(room_),
      clock_(config.sync.tick_hz) {
  if (config_.sync.policy->InputsOnly()) {
    input_room_ = std::make_unique<InputRoom>(config_.sync, replica_, sessions_, broadcast_);
  }
  if (recorder.listening()) replica_.WatchDivergences();
  auditor_ = MakeAuditor();
  replica_.OnCorrected([this](int body, const BodyState& by) { NoteCorrected(body, by); });
  if (!Rules::Needed(scene_)) return;
  commands_ = std::make_unique<ServerCommands>(replica_, *edits_, sessions_);
  rule_source_ = std::make_unique<AuthoritySource>(replica_, authority_, stats_.counters);
  rules_ = std::make_unique<Rules>(replica_.world(), config_.seed, *commands_, rule_source_.get());
  if (rules_->WantTouches()) replica_.WatchTouches();
  if (config_.trust != TrustMode::kAct) return;
  rule_source_->Doubt([this](int body) { return filter_.plausible().OnProbation(body); });
}

Server::~Server() = default;

void Server::Tick(std::int64_t now_us, std::int64_t cpu_us) {
  net_.Advance(now_us);
  if (over_) return AnswerOnly(now_us);
  ReceiveAll(now_us);
  sessions_.DropSilent(now_us);
  FollowSessions(now_us);
  sessions_.Advance(now_us);
  FollowSessions(now_us);
  if (std::exchange(look_soon_, false)) {  // once for all clients that became ready
    broadcast_.LookAround(now_us);
    FindRelevantPlayers();
  }
  ReleaseSilentDrivers(now_us);
  StartIfReady(now_us);
  room_feed_.Publish(now_us, broadcast_);
  const std::int64_t before = replica_.tick();
  if (input_room_ != nullptr) RunInputRoom(now_us);
  for (int steps = 0; steps < kStepsMax && now_us >= next_tick_us() && replica_.MayStep();
       ++steps) {
    stats_.NoteLate(now_us - next_tick_us());
    chronicle_->NoteTick(now_us - next_tick_us());
    StepOnce(now_us);
  }
  WatchClock(now_us);
  if (stats_.Due(now_us)) {
    broadcast_.Publish(stats_.Report(now_us, replica_.tick(), cpu_us, sessions_.WorstRttUs(),
                                     sessions_.WorstLossPpm()));
    if (const auto parted = replica_.TakeDivergence(now_us)) broadcast_.Publish(*parted);
    sessions_.ReadAccounts(&stats_.connections);
  }
  if (started() && chronicle_->SumIsDue(now_us)) chronicle_->Publish(now_us, Sum(now_us));
  // No client gets a key of a place that the log does not have.
  const bool places = NotePlaces(now_us);
  if (replica_.tick() != before || !started() || places) {
    broadcast_.EndTick(now_us, replica_.tick() != before);
  }
  broadcast_.SendWaiting(now_us, replica_.tick() != before);
  RelayInputs(now_us);
  sessions_.Flush(now_us, &stats_.counters);
  RunAudit(now_us);
}

std::int64_t Server::next_tick_us() const {
  if (!started() || over_) return std::numeric_limits<std::int64_t>::max();
  return clock_.DueUs(replica_.tick() + 1);
}

std::int64_t Server::wake_us() const {
  return replica_.MayStep() ? next_tick_us() : std::numeric_limits<std::int64_t>::max();
}

void Server::TellWaiting(std::int64_t now_us, int needed) {
  if (waiting_told_us_ < 0) waiting_told_us_ = now_us;  // who joins at the same time needs no news
  if (now_us - waiting_told_us_ < kTellWaitingUs) return;
  waiting_told_us_ = now_us;
  const bool all = static_cast<std::size_t>(needed) == missing().size();
  Event event;
  event.utime = now_us;
  event.tick = replica_.tick();
  event.text =
      "waiting for " + (all ? "" : std::to_string(needed) + " more of ") + MissingPlayers(*this);
  const Bytes message = Encode(event);
  sessions_.ForEachReady(0, [&](Session& session) { sessions_.SendTo(session, message); });
}

void Server::StartIfReady(std::int64_t now_us) {
  if (started()) return;
  const std::vector<int>& peers = sessions_.PeerOfPlayer();
  const auto ready = std::count_if(peers.begin(), peers.end(), [](int peer) { return peer > 0; });
  if (ready < config_.wait_players) {
    if (ready > 0) TellWaiting(now_us, config_.wait_players - static_cast<int>(ready));
    return;
  }
  clock_.Start(now_us + (config_.wait_players > 0 ? kLeadInUs : 0));
  // Clients that are ready at the start have their mechanisms from tick 0 on: plan once, now.
  UpdateAuthority(now_us);
  PublishShown(now_us);
  Event event =
      MakeEvent(EventKind::kStarted, "the room starts with " + std::to_string(ready) + " players");
  event.value_milli = 1000 * ready;
  chronicle_->Say(now_us, event);
  Tell("the room starts");
}

void Server::StepOnce(std::int64_t now_us) {
  for (const Inputs& inputs : config_.sync.policy->KnownInputs(scene_, replica_.tick() + 1,
                                                               config_.sync.input_delay_ticks)) {
    replica_.RecordInputs(inputs);
    broadcast_.Publish(At(now_us, inputs));
  }
  ApplyEdits(now_us);
  if (rules_ != nullptr) {
    for (const LcmHeard& heard : rules_->TakeQueued())
      broadcast_.NoteAccepted(now_us, 0, -1, heard);
  }
  broadcast_.NoteStep();
  replica_.Step();
  ApplyQueued(now_us);  // edits of this very tick
  TakeWaitingBreaks(now_us);
  TakeWaitingStates(now_us);
  FollowLadder(now_us);
  for (const FoundEdit& found : replica_.TakeProposals()) edits_->Add(found.edit, found.tick);
  std::vector<int> differing;
  for (const std::int32_t id : replica_.TakeDiffering()) {
    const int m = replica_.authority().IndexOf(id);
    if (m >= 0) differing.push_back(m);
  }
  if (!differing.empty()) TellDiffering(0, differing);
  RunSeats(now_us);
  RemoveOutside(now_us);
  UpdateAuthority(now_us);
  for (States& states : replica_.TakeStates()) {
    states.utime = now_us;
    broadcast_.Relay(now_us, states, 0);
    states.peer = 0;  // the server's words, also those about the bodies of a silent holder
    broadcast_.Publish(states);
  }
  TellRest(now_us);
  PublishShown(now_us);
  for (const Meta& meta : settings_.table().TakeChanges(now_us, replica_.tick())) {
    broadcast_.ToAll(meta);
  }
  RunRules(now_us);
  broadcast_.NoteTick();
  broadcast_.SendSettledWorlds(now_us);
  if (input_room_ != nullptr) input_room_->GiveWorlds(now_us, *edits_);
}

void Server::PublishShown(std::int64_t now_us) {
  if (!broadcast_.ShowsViews()) return;
  const Publish publish = Resolved(config_.publish, replica_.world().body_count());
  const View view = replica_.MakeView(publish == Publish::kAll);
  broadcast_.Publish(At(now_us, view));
  if (publish != Publish::kAll || replica_.tick() == 0) return;
  const Strands strands = replica_.MakeStrands(view);
  if (!strands.strand.empty()) broadcast_.Publish(At(now_us, strands));
  const Impacts impacts = replica_.MakeImpacts();
  if (!impacts.id_a.empty()) broadcast_.Publish(At(now_us, impacts));
}

void Server::ApplyEdits(std::int64_t now_us) {
  edits_->NoteComplete(InputsKnownUntil());
  const EditLog::Batch batch = edits_->OrderPending(now_us);
  stats_.counters.dropped_stale += batch.stale;
  for (const EditOrder& order : batch.orders) {
    if (batch.numbered) broadcast_.Publish(order);
    sessions_.SendToAll(Encode(order));
    replica_.Queue(order);
  }
  ApplyQueued(now_us);
}

/// Adds another blast while something hangs in the air. One blast frees only so many of the hanging
/// bricks, and removing a part may leave bricks without support.
void Server::LetFall(const Edit& applied, bool hung) {
  const std::optional<Vec2>& hanging = replica_.world().topology().hanging();
  // While something hangs, each blast adds the next one.
  if (!hanging || (hung && applied.As<BlastEdit>() == nullptr)) return;
  edits_->Add(Edit(BlastEdit{*hanging, kLetFallRadius, 0, 0}, EditCause::kOutside));
}

void Server::ApplyQueued(std::int64_t now_us) {
  while (replica_.has_queued()) {
    const Edit edit = replica_.next_queued();
    const bool hung = replica_.world().topology().hanging().has_value();
    chronicle_->NoteEdit(now_us, edit);
    if (auditor_ != nullptr) auditor_->NoteEdit(edit);
    filter_.NoteEdit(edit);
    replica_.ApplyNextEdit();
    broadcast_.NoteAllUnsettled();
    bounds_.NoteApplied(edit);
    if (const std::optional<EditOrder> order = edits_->NoteApplied(edit, now_us)) {
      broadcast_.Publish(*order);
    }
    LetFall(edit, hung);
  }
}

void Server::UpdateAuthority(std::int64_t now_us) {
  AuthorityManager::PlannerInputs situation;
  situation.peer_of_player = sessions_.PeerOfPlayer();
  situation.one_way_s.reserve(situation.peer_of_player.size());
  for (int& peer : situation.peer_of_player) {
    Session* session = sessions_.Find(peer);
    const std::int64_t rtt_us = session != nullptr ? session->link.rtt_us() : 0;
    const bool silent = session != nullptr && session->stage == SessionStage::kReady &&
                        now_us - session->link.last_receive_us() > kSilentUs;
    if (silent) situation.silent.Add(peer);
    if (session != nullptr && session->lapsed) peer = -1;
    if (session != nullptr && !MayHold(session->player)) situation.untrusted.Add(session->peer);
    situation.load.push_back(session != nullptr ? session->LoadAt(now_us) : -1.0f);
    situation.sent_us.push_back(session != nullptr ? session->link.SentUntilUs(now_us) : now_us);
    situation.one_way_s.push_back(static_cast<float>(std::max<std::int64_t>(0, rtt_us)) * 0.5e-6f);
  }
  situation.together = edits_->WaitingMechanisms();
  situation.shown = broadcast_.ShowsViews();
  situation.falls = [this](PartId id) { return broadcast_.Falls(id); };
  const std::vector<Grants> grants = authority_.Update(now_us, situation);
  for (AuthorityManager::Given& given : authority_.TakeGiven()) {
    given.exact.utime = now_us;
    Session* session = sessions_.Find(given.peer);
    if (session != nullptr) sessions_.SendUrgentTo(*session, Encode(given.exact));
  }
  broadcast_.Tell(grants);
  NoteAuthority(now_us);
  chronicle_->CountHandOvers();
  UpdateInterest(now_us, !grants.empty());
  broadcast_.SendPendingGrants(now_us);
  EndLeases(now_us);
}

/// Puts changes of the server's own table into the log: it is not always what clients are told.
void Server::NoteAuthority(std::int64_t now_us) {
  std::vector<int> set = authority_.TakeSet();
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
  for (const Grants& grants :
       std::as_const(replica_).authority().Export(now_us, replica_.tick(), set)) {
    broadcast_.NoteAccepted(now_us, 0, -1, grants);
  }
}

void Server::UpdateInterest(std::int64_t now_us, bool changed) {
  // One tick after the plan, which takes as much time.
  const int every = broadcast_.ticks_per_look();
  const bool due = replica_.tick() % every == std::min(1, every - 1) || broadcast_.stale();
  if (due) broadcast_.LookAround(now_us);
  if (due || changed) FindRelevantPlayers();
  broadcast_.RefreshDistant(now_us);
}

void Server::RunRules(std::int64_t now_us) {
  if (rules_ == nullptr) return;
  rule_source_->NoteTick(replica_.TakeTouches());
  rules_->AfterTick();
  if (rules_->WantTouches()) replica_.WatchTouches();
  for (const Event& event : commands_->TakeSaid()) chronicle_->Say(now_us, event);
  for (const Meta& meta : rules_->TakeChanges(now_us)) {
    chronicle_->NoteValues(now_us, meta);
    broadcast_.ToAll(meta);
  }
}

}  // namespace seam
