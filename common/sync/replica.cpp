#include "common/sync/replica.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/sync/input_source.h"

namespace seam {
namespace {

/// Ticks of history: 2 s at 60 Hz. A state older than that is corrected without looking back.
constexpr int kHistoryTicks = 120;
/// Bodies stay coupled for this long after they last touched, s: contact flickers.
constexpr double kCoupledHold = 0.25;

}  // namespace

Replica::Replica(const Scene& scene, const SyncConfig& config, int self, int own_player)
    : config_(config),
      self_(self),
      own_player_(own_player),
      world_(scene),
      table_(world_.composition()),
      history_(world_.body_count(), kHistoryTicks),
      smoother_(world_.body_count(), config.smooth),
      snapshots_(world_.body_count()),
      delay_(config.send_every()),
      tracks_(scene.players.size()) {
  const auto bodies = static_cast<std::size_t>(world_.body_count());
  last_impact_tick_.assign(bodies, -1000000);
  last_coupled_tick_.assign(world_.composition().mechanisms.size(), -1000000);
  heard_tick_.assign(bodies, -1);
  dynamic_since_.assign(bodies, 0);
  placed_.assign(bodies, true);
  priority_.assign(bodies, 0.0f);
  pressed_now_.assign(scene.players.size(), 0);
  asleep_since_.assign(bodies, -1);
  changed_at_.assign(bodies, 0);
  if (config.pull != nullptr) pulls_.resize(bodies);
  // Where everything is at tick 0, and how it moves, is known to all from the scene.
  for (int body = 0; body < world_.body_count(); ++body) snapshots_.Add(body, 0, world_.Read(body));
  RolesChanged();
  RecordHistory();
}

void Replica::StartAt(std::int64_t tick) {
  if (tick == world_.tick()) return;
  placed_.assign(placed_.size(), false);
  world_.SetTick(tick);
  history_.Clear();
  barriers_.clear();
  replay_from_ = -1;
  RecordHistory();
}

std::int8_t Replica::RoleOf(int mechanism) const {
  const AuthorityRecord& h = table_.at(mechanism);
  if (config_.mode == Mode::kOracle) return self_ == 0 ? kRoleAuthority : kRoleSecondary;
  if (h.authority == self_) return kRoleAuthority;
  if (config_.mode == Mode::kCentral) {
    const int owner = world_.composition().mechanisms[static_cast<std::size_t>(mechanism)].owner;
    return own_player_ >= 0 && owner == own_player_ ? kRoleSecondary : kRoleRemote;
  }
  if (config_.mode == Mode::kBuffer && h.secondaries.Has(self_)) return kRoleSecondary;
  return kRoleRemote;
}

bool Replica::Simulated(int mechanism) const { return RoleOf(mechanism) != kRoleRemote; }

std::vector<int> Replica::ApplyGrants(const Grants& grants) {
  ApplyEdits();  // the grants are about what is there after them
  std::vector<int> before;
  for (int m = 0; m < table_.count(); ++m) before.push_back(table_.at(m).authority);
  std::vector<int> changed = table_.Apply(grants);
  changed.erase(
      std::remove_if(
          changed.begin(), changed.end(),
          [&](int m) { return before[static_cast<std::size_t>(m)] == table_.at(m).authority; }),
      changed.end());
  RolesChanged();
  return changed;
}

void Replica::RolesChanged() {
  for (int body = 0; body < world_.body_count(); ++body) {
    const Motion wanted = Simulated(world_.mechanism(body)) ? Motion::kDynamic : Motion::kKinematic;
    if (world_.motion(body) == wanted) continue;
    // What was simulated here is from now on reckoned from where it is, not from what was last
    // heard of it, which may be from before this peer had the authority.
    if (wanted == Motion::kKinematic) snapshots_.Add(body, tick(), world_.Read(body));
    world_.SetMotion(body, wanted);
    if (wanted != Motion::kDynamic || !snapshots_.has(body)) continue;
    // What was only displayed had the velocity of its display, not of a body: start from the
    // authority's.
    const BodyState before = world_.Read(body);
    BodyState state = snapshots_.Extrapolate(body, tick(), world_.dt(), kReckonMax);
    state.angle = before.angle + std::remainder(state.angle - before.angle, 6.2831853f);
    world_.Write(body, state);
    smoother_.Moved(body, Minus(state, before));
    dynamic_since_[static_cast<std::size_t>(body)] = tick();
    if (BodyState* now = history_.At(tick(), body)) *now = state;
  }
}

void Replica::ReleaseAll() {
  for (int m = 0; m < table_.count(); ++m) {
    AuthorityRecord h = table_.at(m);
    if (h.authority != self_) continue;
    h.authority = 0;
    table_.Set(m, h);
  }
  RolesChanged();
}

void Replica::ApplyInputs(std::int64_t next) {
  for (std::size_t p = 0; p < tracks_.size(); ++p) {
    const int player = static_cast<int>(p);
    if (config_.mode == Mode::kOracle) {
      tracks_[p].Note(next, ScriptedInput(scene(), player, next));
    }
    world_.SetInput(player, tracks_[p].At(next));
    const std::int16_t pressed = tracks_[p].TakePresses(next);
    pressed_now_[p] |= pressed;
    const std::vector<Action>& actions = scene().players[p].actions;
    for (std::size_t a = 0; a < actions.size(); ++a) {
      if (((pressed >> actions[a].button) & 1) == 0) continue;
      const int assembly =
          world_.composition().assembly_of_part[static_cast<std::size_t>(actions[a].part)];
      if (assembly < 0) continue;  // the part has left
      const int m = world_.composition().assemblies[static_cast<std::size_t>(assembly)].mechanism;
      // Exactly one peer pushes: the authority, when it hears of it (all of them in the oracle).
      const bool alone = config_.mode == Mode::kOracle;
      const bool mine = alone || (m >= 0 && table_.at(m).authority == self_);
      if (!mine) continue;
      world_.Act(player, static_cast<int>(a));
      if (config_.resimulates) acted_.push_back({next, player, static_cast<int>(a)});
    }
  }
}

void Replica::NoteImpacts() {
  for (const Impact& impact : world_.impacts()) {
    if (impact.dv < kMajorImpact) continue;
    for (int body : {impact.body_a, impact.body_b}) {
      if (body >= 0) last_impact_tick_[static_cast<std::size_t>(body)] = tick();
    }
  }
}

void Replica::NoteTouches() {
  for (const Touch& touch : world_.touches()) {
    const int a = world_.mechanism(touch.body_a);
    const int b = world_.mechanism(touch.body_b);
    if (table_.at(a).authority == table_.at(b).authority) continue;
    last_coupled_tick_[static_cast<std::size_t>(a)] = tick();
    last_coupled_tick_[static_cast<std::size_t>(b)] = tick();
  }
}

void Replica::RecordHistory() {
  std::vector<BodyState> states;
  states.reserve(static_cast<std::size_t>(world_.body_count()));
  for (int body = 0; body < world_.body_count(); ++body) states.push_back(world_.Read(body));
  history_.Record(tick(), states);
}

void Replica::Step() {
  ApplyEdits();
  const std::int64_t next = tick() + 1;
  if (config_.resimulates) Resimulate();
  ApplyInputs(next);
  if (config_.mode != Mode::kOracle) DriveKinematic(next);
  if (config_.pull != nullptr) PullCopies(next);
  world_.Step();
  NoteImpacts();
  NoteTouches();
  NoteProposals();
  outgoing_.clear();
  if (config_.mode != Mode::kOracle && next % config_.send_every() == 0) {
    std::vector<PackedBody> bodies = ChooseBodies();
    outgoing_ = Pack(Header(), bodies);
  }
  RecordHistory();
  if (config_.resimulates) TakeBarrier();
  for (int body = 0; body < world_.body_count(); ++body) {
    smoother_.Advance(body, world_.dt(), world_.Read(body).velocity.norm());
  }
  std::vector<States> waiting;
  waiting.swap(early_);
  for (const States& states : waiting) Receive(states);
}

float Replica::GainFor(float dt) const {
  // A pure correction delayed by d updates is stable below 2 sin(pi / (2 (2 d + 1))).
  const double d = std::ceil(static_cast<double>(dt) * config_.send_hz);
  const double limit = 2 * std::sin(3.14159265358979 / (2 * (2 * d + 1)));
  constexpr double kShareOfLimit = 0.25;  // above 0.4 a tall stack never rests at 200 ms
  return static_cast<float>(std::min(1.0, kShareOfLimit * limit));
}

}  // namespace seam
