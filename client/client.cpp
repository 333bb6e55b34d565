#include "client/client.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/physics/stage.h"
#include "common/scene/character.h"
#include "common/sync/edits/edit_order.h"
#include "common/sync/lease.h"

namespace seam {
namespace {

constexpr std::int64_t kPingFastUs = 50000;      // until the room has begun
constexpr std::int64_t kPingSettlingUs = 20000;  // then, until the clock has settled
constexpr std::int64_t kPingSlowUs = 100000;
constexpr std::int64_t kPingQuietUs = 1000000;  // while everything rests
/// An unanswered ping of a quiet room is repeated after the usual round trip and this, us: after
/// the lease nobody would know the authorities.
constexpr std::int64_t kPingAgainUs = 50000;
/// Upper limit of that usual round trip, us, whatever the path or a pause of this process made of
/// it: then a second and a half of repeats fit into the lease.
constexpr std::int64_t kUsualMaxUs = 500000;
static_assert(kPingQuietUs + kUsualMaxUs <= kLeaseUs / 2,
              "one lost ping of a quiet room would end its lease");
/// A neutral input that has been sent for this long, s, has arrived in spite of loss.
constexpr std::int64_t kInputKnownAfter = 2;
/// Most ticks stepped in one call. If further behind than kGiveUpTicks we rejoin.
constexpr int kCatchUpSteps = 20;
constexpr std::int64_t kGiveUpTicks = 300;
/// A late joiner waits this long after it has the room for all bodies' states, us; then it starts
/// with those it has.
constexpr std::int64_t kWorldWaitUs = 4000000;
/// States older than the round trip and this are not current, us.
constexpr std::int64_t kWorldAgeUs = 250000;
/// A late joiner starts up to 1 s / kCatchesUpPart ago, with the states of that time, and steps up
/// to now.
constexpr std::int64_t kCatchesUpPart = 4;
/// Mode central: inputs should arrive this long before the server needs them, us, and at least a
/// tick: one that is late costs a whole tick, however long.
constexpr std::int64_t kInputMarginUs = 35000;
/// The same where datagrams are lost, or too few came to know: a burst may take an input and its
/// first repeats. With less some act late; with more, copies are stepped again from older states.
constexpr std::int64_t kInputMarginLossUs = 5 * kInputRepeatUs;
/// With a tap: ticks shown later than the states of most of them come, and the most of all that,
/// us. With fewer a tick's states are passed on after it; with more watchers see the room older.
constexpr double kLagTicks = 2, kLagMostUs = 500000;
/// Change of lead and lag in a step, as a share of it: no eye sees it.
constexpr double kSlewShare = 0.02;

}  // namespace

Client::Client(const ClientConfig& config, Net& net, Recorder& recorder, Entropy& entropy)
    : config_(config),
      net_(net),
      recorder_(recorder),
      entropy_(entropy),
      key_(config.key),
      home_(config.server) {}

void Client::Tick(std::int64_t now_us, std::int64_t cpu_us) {
  net_.Advance(now_us);
  if (closed_ || !fatal_.empty()) return;
  if (number_ == 0) Join(now_us);
  if (std::exchange(loaded_now_, false)) answered_us_ = received_us_ = now_us;
  ReceiveAll(now_us);
  if (closed_ || !fatal_.empty()) return;
  const std::int64_t silence_us = now_us - answered_us_;
  if (silence_us > kLeaseUs && replica_ != nullptr && !released_ && !moving_) {
    SendReleaseOfAll(now_us);
    replica_->ReleaseAll();
    released_ = true;
  }
  // A session that has released its mechanisms is not resumed: the server may have given them to
  // others. Nor is one without a welcome: the server may have had it and dropped it, and another
  // Join with its number is ignored.
  const bool lost = silence_us > kLostUs && (peer_ >= 0 || !offers_.empty());
  if (!moving_ && (lost || (peer_ >= 0 && released_ && silence_us < kLeaseUs))) {
    Join(now_us);
  }
  TryElsewhere(now_us);
  if (peer_ < 0 || moving_) {
    SendHelloOrJoin(now_us);
  } else if (asked_names_us_ >= 0) {
    AskNames(now_us);
  } else {
    SendReadyAndPing(now_us);
  }
  // Loading takes seconds if the scene is long: `now_us` is from before.
  if (!loaded_now_) StartIfDue(now_us);
  late_us_ = 0;
  line_ready_ = LineReady(now_us);
  const std::int64_t before = replica_ != nullptr ? replica_->tick() : 0;
  if (started_) StepDue(now_us);
  const auto ticks = replica_ != nullptr ? static_cast<int>(replica_->tick() - before) : 0;
  if (started_) load_.Note(now_us, cpu_us, std::max(0, ticks), late_us_, 1000000 / room_.tick_hz);
  const bool stats_due = now_us - last_stats_us_ >= 1000000;
  if (publisher_ != nullptr && peer_ >= 0 && stats_due) PublishStats(now_us, cpu_us);
  if (ticks > 0) publisher_->EndTick(now_us, peer_, replica_->tick());
  if (started_) SendInputs(now_us);
  if (LineReady(now_us)) Flush(now_us);
  net_.Flush();
}

void Client::SendReadyAndPing(std::int64_t now_us) {
  if (!said_ready_ && replica_ != nullptr && clock_.settled()) {
    said_ready_ = true;
    redirects_ = 0;
    ++sessions_;
    Ready ready;
    ready.utime = now_us;
    link_->SendReliable(Encode(ready));
  }
  std::int64_t every_us = clock_.settled() ? kPingSlowUs : kPingSettlingUs;
  if (!timeline_.known()) every_us = kPingFastUs;
  if (Quiet()) {
    every_us = PongOverdue(now_us) ? kPingAgainUs : kPingQuietUs;
  }
  link_->SetQuiet(Quiet());
  if (now_us - last_ping_us_ >= every_us) {
    last_ping_us_ = now_us;
    Ping ping;
    ping.utime = now_us;
    if (replica_ != nullptr && started_) {
      ping.revision = replica_->revision();
      ping.composition = static_cast<std::int64_t>(replica_->world().composition().hash);
      ping.rest = static_cast<std::int64_t>(replica_->rest().Hash());
      const RestBlock at = RestBlock::Of(replica_->world().body_count(), rest_turn_++);
      ping.rest_blocks = static_cast<std::int16_t>(at.blocks);
      ping.rest_block = static_cast<std::int16_t>(at.block);
      ping.rest_part = static_cast<std::int32_t>(replica_->rest().HashOf(at, -1));
      ping.load = std::max(load_.permille(), LineLoad(now_us));
      if (policy_->InputsOnly()) AddWorldHash(&ping);
    }
    link_->SendUnreliable(Encode(ping));
  }
}

bool Client::PongOverdue(std::int64_t now_us) const {
  if (answered_us_ >= last_ping_us_) return false;
  const std::int64_t usual_us = std::min<std::int64_t>(clock_.rtt_p90_us(), kUsualMaxUs);
  const std::int64_t period_us = Quiet() ? kPingQuietUs : kPingSlowUs;
  return now_us - answered_us_ >= period_us + usual_us + kPingAgainUs;
}

std::int64_t Client::LeadTarget() const {
  const std::int64_t tick_us = 1000000 / room_.tick_hz;
  const bool loses = link_->loss_ppm() > 0 || !link_->loss_known();
  const std::int64_t margin_us = loses ? kInputMarginLossUs : kInputMarginUs;
  return clock_.rtt_p90_us() / 2 + std::max(margin_us, tick_us);
}

std::int64_t Client::RoomTime(std::int64_t now_us) {
  std::int64_t time = timeline_.At(clock_.ServerTime(now_us));
  if (policy_->RunsAhead()) {
    if (lead_us_ < 0) lead_us_ = static_cast<double>(LeadTarget());
    time += static_cast<std::int64_t>(lead_us_);
  }
  if (config_.tap != nullptr) {
    if (lag_us_ < 0) lag_us_ = LagTarget();
    time -= static_cast<std::int64_t>(lag_us_);
  }
  return time;
}

/// The time that nine in ten messages take, if all jitter is of their direction.
double Client::LagTarget() const {
  const auto path_us = static_cast<double>(clock_.rtt_p90_us() - clock_.rtt_min_us() / 2);
  return std::min(path_us + kLagTicks * 1000000 / room_.tick_hz, kLagMostUs);
}

void Client::StartIfDue(std::int64_t now_us) {
  if (started_ || replica_ == nullptr || !clock_.settled() || !timeline_.known()) return;
  const std::int64_t time = RoomTime(now_us);
  if (time < 0) return;
  if (policy_->InputsOnly()) {
    started_ = world_given_;  // it begins where that world is
    return;
  }
  // Within the first half second we count as present from the start, only late in stepping.
  const std::int64_t tick = time * room_.tick_hz / 1000000;
  const bool late = tick > room_.tick_hz / 2;
  const bool waits = now_us - received_us_ < kWorldWaitUs;
  const std::int64_t age_us = clock_.rtt_p90_us() + kWorldAgeUs;
  const std::int64_t from = tick - age_us * room_.tick_hz / 1000000;
  if (late && waits && !held_.Covers(replica_->world(), from)) return;
  const std::int64_t oldest = tick - room_.tick_hz / kCatchesUpPart;
  if (late) replica_->StartAt(held_.TickOf(replica_->world(), oldest, tick));
  started_ = true;
  held_.GiveTo(*replica_);
  if (late) CatchUp(tick);
  EndUnlessGood(held_.GiveWorldTo(*replica_));
  held_.Clear();
}

/// Steps without display; messages of these ticks are discarded.
void Client::CatchUp(std::int64_t tick) {
  for (; replica_->tick() < tick; replica_->Step()) RecordKnownInputs();
  replica_->TakeStates();
  replica_->TakeProposals();
  replica_->TakeImpactReports();
  replica_->TakeTouchReports();
}

void Client::StepDue(std::int64_t now_us) {
  const std::int64_t hz = room_.tick_hz;
  const std::int64_t time = RoomTime(now_us);
  const std::int64_t due = time * hz / 1000000;
  if (due - replica_->tick() > kGiveUpTicks &&
      !moving_) {  // suspended for seconds: the server dropped us
    Join(now_us);
    return;
  }
  for (int steps = 0; steps < kCatchUpSteps && replica_->tick() < due; ++steps) {
    late_us_ = std::max(late_us_, time - (replica_->tick() + 1) * 1000000 / hz);
    worst_late_us_ = std::max(worst_late_us_, late_us_);
    if (!MayStep()) return;
    StepOnce(now_us);
    const double most = 1000000.0 / static_cast<double>(hz) * kSlewShare;
    if (lead_us_ >= 0) {
      lead_us_ += std::clamp(static_cast<double>(LeadTarget()) - lead_us_, -most, most);
    }
    if (lag_us_ >= 0) lag_us_ += std::clamp(LagTarget() - lag_us_, -most, most);
  }
}

bool Client::Quiet() const {
  if (replica_ == nullptr || !started_ || !rest_agrees_ || !replica_->rest().all()) return false;
  if (policy_->InputsOnly()) return false;  // others wait for each input
  const bool idle = replica_->tick() - idle_since_ > kInputKnownAfter * room_.tick_hz;
  return idle && !link_->reliable_pending();
}

void Client::TellRest(std::int64_t now_us) {
  for (Rest& rest : replica_->rest().Take()) {
    rest.utime = now_us;
    if (!released_) link_->SendReliable(Encode(rest));
  }
}

bool Client::EditsWait() {
  const int revision = replica_->revision();
  if (edits_wait_revision_ != revision) {
    edits_wait_revision_ = revision;
    edits_wait_ = policy_->SendsCompleteTicks() && ProposesEdits(replica_->world().scene());
  }
  return edits_wait_;
}

void Client::StepOnce(std::int64_t now_us) {
  FollowSettings();
  RecordOwnInput();
  RecordKnownInputs();
  replica_->Step();
  if (policy_->AppliesFoundEdits()) replica_->ApplyEdits();  // in the tick in which they were found
  for (const FoundEdit& found : replica_->TakeProposals()) {
    EditOrder proposal = ToOrder(found.edit);
    proposal.utime = now_us;
    proposal.tick = found.tick;
    proposal.sequence = replica_->revision();
    if (!released_) link_->SendUrgent(Encode(proposal));
  }
  for (ImpactReport& report : replica_->TakeImpactReports()) {
    report.utime = now_us;
    if (!released_) link_->SendReliable(Encode(report));
  }
  for (TouchReport& report : replica_->TakeTouchReports()) {
    report.utime = now_us;
    if (!released_) link_->SendReliable(Encode(report));
  }
  if (!released_) SendStates(now_us);
  Differing differing{replica_->TakeDiffering()};
  if (differing.mechanism.size() > kDifferingMax) differing.mechanism.resize(kDifferingMax);
  if (!differing.mechanism.empty()) link_->SendUnreliable(Encode(differing));
  TellRest(now_us);
  PublishShown(now_us);
}

Publish Client::Published(int bodies) const {
  return recorder_.listening() ? Resolved(config_.publish, bodies) : Publish::kNone;
}

void Client::PublishShown(std::int64_t now_us) {
  const Publish published = Published(replica_->world().body_count());
  if (published == Publish::kNone) return;
  View view = replica_->MakeView(published == Publish::kAll);
  view.utime = now_us;
  publisher_->Publish(view);
  if (published != Publish::kAll) return;
  Strands strands = replica_->MakeStrands(view);
  strands.utime = now_us;
  if (!strands.strand.empty()) publisher_->Publish(strands);
  Impacts impacts = replica_->MakeImpacts();
  impacts.utime = now_us;
  if (!impacts.id_a.empty()) publisher_->Publish(impacts);
}

std::int64_t Client::next_tick_us(std::int64_t now_us) {
  // While joining, 10 ms is often enough; then the timeline decides.
  if (!started_) return now_us + 10000;
  const std::int64_t time = RoomTime(now_us);
  const std::int64_t next = (replica_->tick() + 1) * 1000000 / room_.tick_hz;
  std::int64_t step_us = timeline_.RealUs(std::max<std::int64_t>(0, next - time)) + 1;
  // A peer that waits for inputs goes on when a datagram brings them.
  if (next <= time && !replica_->MayStep()) step_us = kInputRepeatUs;
  return now_us + std::min(step_us, kInputRepeatUs);
}

void Client::PublishStats(std::int64_t now_us, std::int64_t cpu_us) {
  last_stats_us_ = now_us;
  stats_.utime = now_us;
  stats_.peer = peer_;
  stats_.tick = replica_ != nullptr ? replica_->tick() : 0;
  stats_.cpu_us = cpu_us;
  stats_.rtt_us =
      static_cast<std::int32_t>(std::min<std::int64_t>(clock_.rtt_min_us(), 1000000000));
  stats_.jitter_us = static_cast<std::int32_t>(std::min<std::int64_t>(
      clock_.rtt_min_us() < 0 ? -1 : clock_.rtt_p90_us() - clock_.rtt_min_us(), 1000000000));
  stats_.loss_ppm = static_cast<std::int32_t>(link_->loss_ppm());
  stats_.tick_late_us = static_cast<std::int32_t>(std::min<std::int64_t>(worst_late_us_, 1 << 30));
  stats_.clock_offset_us = static_cast<std::int32_t>(
      std::clamp<std::int64_t>(clock_.pending_us(), -1000000000, 1000000000));
  worst_late_us_ = 0;
  publisher_->Publish(stats_);
  if (replica_ == nullptr) return;
  if (const auto parted = replica_->TakeDivergence(now_us)) publisher_->Publish(*parted);
}

PartId Client::vehicle() const {
  if (scene_ == nullptr || player_ < 0) return -1;
  const Player& player = scene_->players[static_cast<std::size_t>(player_)];
  if (player.vehicle >= 0) return player.vehicle;
  for (const Character& character : scene_->characters) {
    if (character.player == player_) return character.parts[kTorso];
  }
  return -1;
}

}  // namespace seam
