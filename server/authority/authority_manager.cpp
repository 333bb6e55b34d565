#include "server/authority/authority_manager.h"

#include <algorithm>
#include <numeric>

#include "common/physics/stage.h"
#include "common/sync/lease.h"
#include "server/authority/authority_view.h"

namespace seam {
namespace {

/// Larger than the errors that a pending replay will correct, m and m/s.
constexpr float kContestedOff = 0.1f, kContestedVelocity = 1;
/// Time constant with which these errors are forgotten, s.
constexpr int kContestedSeconds = 4;
/// Plans per second: more follow faster bodies; the cost grows with the number of bodies.
constexpr int kPlansPerSecond = 10;

/// Returns a grant of one mechanism with the given record instead of the table's.
Grants Told(std::int64_t now_us, std::int64_t tick, PartId id, const AuthorityRecord& record) {
  Grants told;
  told.utime = now_us;
  told.tick = tick;
  AddRecord(id, record, &told);
  return told;
}

void Append(const std::vector<Grants>& more, std::vector<Grants>* all) {
  all->insert(all->end(), more.begin(), more.end());
}

}  // namespace

AuthorityManager::AuthorityManager(const Scene& scene, const SyncConfig& config, Replica& replica)
    : scene_(scene),
      config_(config),
      replica_(replica),
      physics_edits_(ProposesEdits(scene)),
      islands_(PlansIslands(scene) || config.policy->PlansByTouch()),
      at_rest_(replica.table(), BodyRule::kFresh),
      doubtful_(replica.table(), MechanismRule::kFresh, 1),
      restricted_(RestrictedParts(replica.world().scene())),
      memory_(
          replica.table(),
          [this](int m, const std::vector<const Memory*>& before) { return Merged(m, before); }),
      edited_(replica.table(), [this](const BodyRemap& change) {
        plan_ = PlanAfter(change);
        open_.clear();
        restricted_ = RestrictedParts(replica_.world().scene());
        sleeping_index_.Clear(0);
        plan_due_ = true;
      }) {
  if (!config_.policy->PlansFollowers()) return;
  for (int m = 0; m < table().count(); ++m) {
    AuthorityRecord record;
    record.secondaries.Add(0);
    replica_.authority().Set(m, record);
  }
}

std::vector<Grants> AuthorityManager::Update(std::int64_t now_us, const PlannerInputs& situation) {
  plan_due_ = plan_due_ || !(silent_ == situation.silent);
  plan_due_ = plan_due_ || !(untrusted_ == situation.untrusted);
  silent_ = situation.silent;
  untrusted_ = situation.untrusted;
  replica_.SetSilentHolders(silent_);
  round_trip_us_.clear();
  sent_us_.clear();
  for (std::size_t p = 0; p < situation.one_way_s.size(); ++p) {
    const auto peer = static_cast<std::size_t>(std::max(0, situation.peer_of_player[p]));
    if (round_trip_us_.size() <= peer) {
      round_trip_us_.resize(peer + 1, 0);
      sent_us_.resize(peer + 1, now_us);
    }
    round_trip_us_[peer] = static_cast<std::int64_t>(2e6f * situation.one_way_s[p]);
    if (p < situation.sent_us.size()) sent_us_[peer] = situation.sent_us[p];
  }
  if (plan_due_ || replica_.tick() % std::max(1, config_.tick_hz / kPlansPerSecond) == 0) {
    plan_due_ = false;
    Plan(now_us, situation);
  }
  changed_.clear();
  grants_.clear();  // revocations are sent first
  taken_over_ = false;
  std::size_t left = 0;
  if (sort_open_) std::sort(open_.begin(), open_.end());
  sort_open_ = false;
  for (const int m : open_) {
    if (Advance(now_us, m)) {
      open_[left++] = m;
    } else {
      memory_[m].open = false;
    }
  }
  open_.resize(left);
  if (changed_.empty() && !taken_over_) return std::move(grants_);
  replica_.RolesChanged();
  Append(table().Export(now_us, replica_.tick(), changed_), &grants_);
  return std::move(grants_);
}

void AuthorityManager::Plan(std::int64_t now_us, const PlannerInputs& situation) {
  Look(situation);
  LookAtCapacity(now_us, situation, &view_);
  const auto limited = [](const PlayerView& p) { return p.limited(); };
  limited_ = std::any_of(view_.players.begin(), view_.players.end(), limited);
  if (limited_ && view_.left_out > 0) {  // such a player may have to step any body
    Look(situation);
    LookAtCapacity(now_us, situation, &view_);
  }
  const AuthorityPlan plan = PlanAuthority(view_);
  // Left-out mechanisms have no followers and belong to the server, also by record: MayBeIndexed.
  plan_.resize(static_cast<std::size_t>(table().count()));
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    plan_[static_cast<std::size_t>(seen_[i])] = plan[i];
  }
  replica_.AllowDormant(MayBeDormant(view_), UncertainPeers(view_));
  for (const int m : seen_) {
    const PlannedAuthority& planned = plan_[static_cast<std::size_t>(m)];
    const AuthorityRecord& record = table().at(m);
    const bool same = planned.authority == record.authority &&
                      planned.secondaries == record.secondaries &&
                      memory_[m].hand_over == HandOver::kNone;
    if (!same) Open(m);
  }
}

void AuthorityManager::Open(int m) {
  Memory& memory = memory_[m];
  sleeping_index_.Take(m);
  if (memory.open) return;
  memory.open = true;
  sort_open_ = sort_open_ || (!open_.empty() && open_.back() > m);
  open_.push_back(m);
}

bool AuthorityManager::Advance(std::int64_t now_us, int m) {
  Memory& memory = memory_[m];
  AuthorityRecord record = table().at(m);
  // One authority at a time: the server takes over only once the holder has released it.
  NoteTold(now_us, m);
  if (memory.hand_over == HandOver::kRevoking) {
    if (memory.withdrawn || now_us - memory.asked_us <= PatienceUs(m)) return true;
    Withdraw(m);
    memory.ask_us = now_us + kAskAgainUs;
    return true;
  }
  if (memory.hand_over == HandOver::kOvertaken) {
    memory.hand_over = HandOver::kNone;
    record.epoch += 2;  // later than any epoch sent so far
    SetRecord(m, record);
    changed_.push_back(m);
    return true;
  }
  bool released = false;
  if (memory.hand_over == HandOver::kReleased) {
    released = true;
    memory.hand_over = HandOver::kNone;
    record = WithoutHolder(record);
    SetRecord(m, record);
    taken_over_ = true;
  }
  if (record.authority == 0) ForgetQuestions(m);
  const bool kept = record.authority == 0 && replica_.tick() < memory.keep_until_tick;
  const PlannedAuthority& plan = plan_[static_cast<std::size_t>(m)];
  const int authority = kept ? 0 : plan.authority;
  PeerSet secondaries = plan.secondaries;
  if (kept) secondaries.Add(plan.authority);
  if (record.authority != 0 && authority != record.authority) {
    if (now_us < memory.ask_us) return true;
    if (memory.withdrawn && silent_.Has(record.authority)) return true;
    const bool sent = memory.told_us >= 0 || now_us - memory.asked_us > kTellPatienceUs;
    if (memory.withdrawn && !sent) return true;
    if (!memory.withdrawn) memory.unanswered_us = -1;
    memory.hand_over = HandOver::kRevoking;
    memory.asked_us = now_us;
    memory.told_us = -1;
    memory.revoked_id = table().id(m);
    grants_.push_back(Told(now_us, replica_.tick(), memory.revoked_id, WithoutHolder(record)));
    return true;
  }
  if (authority == record.authority && secondaries == record.secondaries) {
    // In large rooms only the holder heard of the question (GrantAudience).
    const bool others_know = replica_.world().body_count() <= scene_.follow_bodies;
    if (released && !others_know) changed_.push_back(m);
    return kept;
  }
  if (authority != record.authority) {
    if (!released && replica_.tick() > 0) {
      for (ExactStates& exact : replica_.MakeExact({m}, 1)) {
        given_.push_back({authority, std::move(exact)});
      }
    }
    record.epoch += 1;
  }
  record.authority = authority;
  record.secondaries = secondaries;
  SetRecord(m, record);
  changed_.push_back(m);
  return kept;
}

std::int64_t AuthorityManager::PatienceUs(int m) const {
  const auto holder = static_cast<std::size_t>(table().at(m).authority);
  const std::int64_t rtt_us = holder < round_trip_us_.size() ? round_trip_us_[holder] : 0;
  return std::max(kWithdrawUs, kWithdrawRoundTrips * rtt_us);
}

void AuthorityManager::Withdraw(int m) {
  Memory& memory = memory_[m];
  AuthorityRecord record = table().at(m);
  if (memory.held_from < 0) memory.held_from = record.epoch;
  memory.hand_over = HandOver::kNone;
  memory.withdrawn = true;
  record.epoch += 2;  // the question used up one
  SetRecord(m, record);
  changed_.push_back(m);
}

/// Called once another peer has the mechanism, or will have it.
void AuthorityManager::ForgetQuestions(int m) {
  Memory& memory = memory_[m];
  memory.withdrawn = false;
  memory.ask_us = 0;
  memory.held_from = -1;
}

AuthorityManager::Right AuthorityManager::AcceptRelease(int peer, PartId mechanism,
                                                        std::int32_t epoch) {
  const int m = table().IndexOf(mechanism);
  if (m < 0) return Right::kNo;
  const AuthorityRecord& record = table().at(m);
  Memory& memory = memory_[m];
  if (epoch <= record.epoch) {
    // A late answer: the mechanism was granted to it again after the question was withdrawn.
    const bool late = record.authority == peer && memory.held_from >= 0 &&
                      epoch > memory.held_from && (record.epoch - epoch) % 2 == 1;
    const bool wanted = late && memory.hand_over == HandOver::kNone && Wanted(m) == peer;
    if (wanted) memory.withdrawn = false;  // it answers; one that is always late must leave
    return late ? Right::kYes : Right::kStale;
  }
  const bool asked = memory.hand_over == HandOver::kRevoking && record.authority == peer;
  if (!asked || epoch != WithoutHolder(record).epoch) return Right::kNo;
  memory.hand_over = HandOver::kReleased;
  return Right::kYes;
}

bool AuthorityManager::HoldsInEpoch(int peer, PartId mechanism, std::int32_t epoch) const {
  const int m = table().IndexOf(mechanism);
  if (m < 0 || peer <= 0) return false;
  const AuthorityRecord& record = table().at(m);
  const Memory& memory = memory_[m];
  if (record.authority != peer) return false;
  const std::int32_t from = memory.held_from < 0 ? record.epoch : memory.held_from;
  return epoch >= from && epoch <= record.epoch && (record.epoch - epoch) % 2 == 0;
}

AuthorityManager::Right AuthorityManager::RightToRelease(int peer, int body,
                                                         std::int32_t epoch) const {
  const int m = replica_.world().mechanism(body);
  const AuthorityRecord& record = table().at(m);
  if (epoch <= record.epoch) return Right::kStale;
  const bool asked = memory_[m].hand_over == HandOver::kRevoking && record.authority == peer;
  return asked && epoch == WithoutHolder(record).epoch ? Right::kYes : Right::kNo;
}

void AuthorityManager::NoteCopyError(int body, const BodyState& off) {
  if (off.position.norm() <= kJump && off.velocity.norm() <= kJumpVelocity) return;
  const int m = replica_.world().mechanism(body);
  memory_[m].keep_until_tick =
      replica_.tick() + static_cast<std::int64_t>(kConvergeS * config_.tick_hz);
  Open(m);
}

void AuthorityManager::NoteTold(int body, const BodyState& off) {
  const bool far = off.position.norm() > kContestedOff || off.velocity.norm() > kContestedVelocity;
  Memory& memory = memory_[replica_.world().mechanism(body)];
  memory.contested *= 1 - 1 / static_cast<float>(kContestedSeconds * config_.send_hz);
  if (far) memory.contested += 1;
}

void AuthorityManager::AddAwaiting(int body, PeerSet* peers) const {
  const int m = replica_.world().mechanism(body);
  peers->Add(table().at(m).secondaries);
  if (static_cast<std::size_t>(m) < plan_.size()) {
    peers->Add(plan_[static_cast<std::size_t>(m)].authority);
  }
}

AuthorityRecord AuthorityManager::WithoutHolder(AuthorityRecord record) const {
  // A peer that releases goes on simulating until the next grant: its copy is the best there is.
  if (config_.policy->PlansFollowers()) record.secondaries.Add(record.authority);
  record.authority = 0;
  record.epoch += 1;
  return record;
}

AuthorityManager::Memory AuthorityManager::Merged(int m,
                                                  const std::vector<const Memory*>& before) const {
  Memory merged = before.empty() ? Memory{} : *before.front();
  for (const Memory* const old : before) {
    const bool same = before.size() == 1 && old->revoked_id == table().id(m);
    const bool overtaken = old->hand_over != HandOver::kNone && !same;
    if (overtaken) merged.hand_over = HandOver::kOvertaken;
    if (!same) merged.held_from = -1;
  }
  merged.open = false;
  return merged;
}

std::vector<Grants> AuthorityManager::Export(std::int64_t now_us) const {
  std::vector<int> all(static_cast<std::size_t>(table().count()));
  std::iota(all.begin(), all.end(), 0);
  return table().Export(now_us, replica_.tick(), all, [this](int m) {
    const bool moving = memory_[m].hand_over != HandOver::kNone;
    return moving ? WithoutHolder(table().at(m)) : table().at(m);
  });
}

int AuthorityManager::Wanted(int mechanism) const {
  const auto m = static_cast<std::size_t>(mechanism);
  return m < plan_.size() ? plan_[m].authority : table().at(mechanism).authority;
}

bool AuthorityManager::InOneHand(const std::vector<int>& mechanisms) const {
  for (const int m : mechanisms) {
    if (memory_[m].hand_over != HandOver::kNone) return false;
    if (table().at(m).authority != table().at(mechanisms.front()).authority) return false;
  }
  return true;
}

AuthorityManager::Right AuthorityManager::RightToMove(int peer, int body,
                                                      std::int32_t epoch) const {
  const AuthorityRecord& record = table().at(replica_.world().mechanism(body));
  if (record.authority == peer) {
    const int m = replica_.world().mechanism(body);
    const std::int32_t from = memory_[m].held_from < 0 ? record.epoch : memory_[m].held_from;
    // Each question used up one epoch, in which nobody had the mechanism.
    const bool held = epoch >= from && epoch <= record.epoch && (record.epoch - epoch) % 2 == 0;
    return held ? Right::kYes : Right::kStale;
  }
  return epoch < record.epoch ? Right::kStale : Right::kNo;
}

}  // namespace seam
