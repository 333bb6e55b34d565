#include "common/sync/replica.h"

#include <algorithm>

#include "common/scene/mechanism_ids.h"
#include "common/sync/blend/distrusted_rest.h"
#include "common/sync/rollback/presses.h"

namespace seam {
namespace {

/// Most impacts sent per tick; further ones are not displayed.
constexpr std::size_t kImpactsSentMax = 64;

}  // namespace

Replica::Replica(const Topology& topology, const SyncConfig& config, int self, int own_player)
    : config_(config),
      world_(topology),
      table_(world_),
      roles_(config_, self, own_player, world_, table_),
      drivers_(world_, roles_),
      memory_(config_, world_, table_),
      activities_(config_, world_, roles_, memory_),
      inputs_(topology.scene().players.size()),
      display_(config_, world_, memory_, activities_),
      strands_(world_),
      replay_(config_, world_, roles_, drivers_, memory_, display_, inputs_),
      corrector_(config_, world_, roles_, activities_, memory_, display_, replay_),
      reach_(config_, world_, roles_, drivers_, inputs_),
      rest_(MakeRestCommit(config_, world_, roles_, drivers_, memory_, display_, inputs_, reach_)),
      scheduler_(config_, world_, roles_, memory_, reach_, replay_),
      queue_(config_.policy->MakeEditQueue()),
      proposals_(config_.tick_hz),
      impact_reporter_(world_, roles_),
      touches_(world_, roles_, kReplayMax * config_.tick_hz),
      pressed_now_(topology.scene().players.size(), 0),
      pressed_missed_(topology.scene().players.size(), 0) {
  replay_.OnReplayedTick([this] {
    impact_reporter_.Note(true);
    touches_.Note();
    FindEdits();
  });
  FollowRoles();
  memory_.Record();
  replay_.TakeBarrier();  // inputs of the first ticks come late, too
}

void Replica::StartAt(std::int64_t tick) {
  if (tick == world_.tick()) return;
  world_.SetTick(tick);
  activities_.UnparkAll();
  memory_.StartAnew();
  rest_->StartAnew();
  replay_.Forget();
  memory_.Record();
  complete_.StartAt(tick);
}

void Replica::Begin() {
  corrector_.ClosePlaced();
  replay_.TakeBarrier();
}

void Replica::Step() {
  ApplyEdits();
  const std::int64_t next = tick() + 1;
  replay_.Run();
  ApplyInputs(next);
  if (activities_.CheckIfRequested()) corrector_.FollowRoles(BodiesOf(activities_.changed()));
  display_.Drive(next, activities_.around());
  corrector_.PullCopies();
  rest_->BeforeStep();
  memory_.ClearUpdated();
  world_.Step();
  memory_.RecordContacts(roles_.table());
  if (config_.policy->SendsCompleteTicks() && config_.IsLookTick(next)) reach_.Look();
  rest_->AfterStep();
  impact_reporter_.Note();
  touches_.Note();
  FindEdits();
  ProposeFound();
  queue_->AfterStep(tick());
  scheduler_.Collect();
  memory_.Record();
  if (activities_.CheckIfDue()) corrector_.FollowRoles(BodiesOf(activities_.changed()));
  replay_.TakeBarrier();
  display_.Glide(roles_, display_.ShowsPast(roles_) ? reach_.Missing() : MissingInputs());
  corrector_.ReceiveWaiting();
}

void Replica::FollowRoles() {
  drivers_.Look();
  if (corrector_.FollowRoles()) activities_.Ask();
}

void Replica::RecordInput(int player, std::int64_t tick, const Input& input) {
  Inputs one;
  one.player = player;
  one.first_tick = tick;
  one.drive.push_back(input.drive);
  one.lift.push_back(input.lift);
  one.buttons.push_back(input.buttons);
  RecordInputs(one);
}

void Replica::RecordInputs(const Inputs& inputs) {
  InputTrack& track = inputs_[static_cast<std::size_t>(inputs.player)];
  std::vector<std::int64_t> late;  // ticks stepped without these inputs
  std::int64_t wrong = -1;
  for (std::size_t i = 0; i < inputs.drive.size(); ++i) {
    const std::int64_t t = inputs.first_tick + static_cast<std::int64_t>(i);
    if (t <= taken_tick_ || t > tick() || track.knows(t)) continue;
    late.push_back(t);
    const Input is{inputs.drive[i], inputs.lift[i], inputs.buttons[i]};
    if (wrong < 0 && !(track.At(t) == is)) wrong = t;
  }
  track.Note(inputs);
  heard_players_.push_back(inputs.player);
  if (wrong >= 0) display_.NoteLate(inputs.player, tick() - wrong + 1);
  if (!config_.policy->GoesBack(roles_.self())) return;
  if (wrong >= 0 && drivers_.Concerns(inputs.player)) replay_.AskFrom(wrong - 1);
  for (const std::int64_t t : late) {
    if (t > replay_.oldest()) continue;
    pressed_missed_[static_cast<std::size_t>(inputs.player)] |= track.PressedAt(t);
  }
}

void Replica::ApplyInputs(std::int64_t next) {
  // Players who move a mechanism here, and players heard of: buttons count even if they move
  // nothing.
  std::vector<int>& players = heard_players_;
  players.insert(players.end(), drivers_.concerned().begin(), drivers_.concerned().end());
  std::sort(players.begin(), players.end());
  players.erase(std::unique(players.begin(), players.end()), players.end());
  std::size_t left = 0;
  for (const int player : players) {
    const InputTrack& track = inputs(player);
    if (!(track.At(next) == Input{})) NeedDriven(player);
    if (drivers_.Concerns(player)) world_.SetInput(player, track.At(next));
    ApplyPresses(player, next);
    if (track.newest() > next) players[left++] = player;  // inputs still to come
  }
  players.resize(left);
}

/// Makes the mechanisms present that the player's inputs are about to move.
void Replica::NeedDriven(int player) {
  std::vector<int> mechanisms;
  for (const int m : drivers_.MechanismsOf(player)) {
    if (activities_.Need(m)) mechanisms.push_back(m);
  }
  if (!mechanisms.empty()) corrector_.FollowRoles(BodiesOf(mechanisms));
}

/// Performs a player's button actions. Where inputs are stamped, every peer that simulates the
/// pushed mechanism pushes it at that tick; else only the authority does, when it hears of the
/// press.
void Replica::ApplyPresses(int player, std::int64_t next) {
  const auto p = static_cast<std::size_t>(player);
  const std::int16_t heard = inputs_[p].TakePresses(next);
  pressed_now_[p] |= heard;
  const bool stamped = config_.policy->StampsInputs(roles_.self());
  EachAction(world_, player, stamped ? inputs_[p].PressedAt(next) : heard, [&](int a, int m) {
    if (stamped ? roles_.RoleOf(m) != kRoleRemote : roles_.IsAuthority(m)) world_.Act(player, a);
  });
  if (pressed_missed_[p] != 0) NeedDriven(player);
  EachAction(world_, player, std::exchange(pressed_missed_[p], 0), [&](int a, int m) {
    if (roles_.IsAuthority(m)) world_.Act(player, a);
  });
}

std::vector<int> Replica::ApplyGrants(const Grants& grants) {
  queue_->Hurry(tick());
  ApplyEdits();  // the grants refer to the topology after the edits
  GrantsApplied applied = roles_.Apply(grants);
  NoteDiffering({grants.mechanism});  // a new holder's or follower's copies may
  // Before activities follow the roles: the holder's last simulated states.
  for (ExactStates& exact : MakeExact(applied.let_go, 0)) released_.push_back(std::move(exact));
  // In a large room most grants that a client receives are between other peers.
  if (!applied.roles.empty()) {
    drivers_.Look();
    if (corrector_.FollowRoles(BodiesOf(applied.roles))) activities_.Ask();
    rest_->PutBack();
  }
  return std::move(applied.let_go);
}

std::vector<int> Replica::BodiesOf(const std::vector<int>& mechanisms) const {
  std::vector<int> bodies;
  for (const int m : mechanisms) {
    EachIdOf(world_.composition(), m, [&](PartId id) {
      const int body = world_.BodyOfId(id);
      if (body >= 0) bodies.push_back(body);
    });
  }
  std::sort(bodies.begin(), bodies.end());
  return bodies;
}

void Replica::NoteDiffering(const Differing& differing) {
  for (const std::int32_t id : differing.mechanism) {
    const int m = roles_.table().IndexOf(id);
    if (m >= 0) memory_.NoteUnsettled(m);
  }
}

void Replica::ReleaseAll() {
  roles_.ReleaseAll();
  RolesChanged();
}

Received Replica::Receive(const States& states) {
  ApplyEdits();
  return corrector_.Receive(states);
}

void Replica::Receive(const Rest& rest) {
  ApplyEdits();
  if (rest_->Receive(rest)) replay_.Forget();  // replays cannot reach the time before it
}

void Replica::Place(const States& states) {
  ApplyEdits();
  corrector_.Place(states);
}

Impacts Replica::MakeImpacts() const {
  Impacts out;
  out.peer = roles_.self();
  out.tick = tick();
  for (const Impact& impact : world_.impacts()) {
    if (impact.dv < kMajorImpact || out.id_a.size() >= kImpactsSentMax) continue;
    out.id_a.push_back(impact.body_a < 0 ? -1 : world_.id(impact.body_a));
    out.id_b.push_back(impact.body_b < 0 ? -1 : world_.id(impact.body_b));
    out.x.push_back(impact.point.x());
    out.y.push_back(impact.point.y());
    out.dv.push_back(impact.dv);
  }
  return out;
}

}  // namespace seam
