#include "common/sync/replica.h"

#include "common/sync/input_source.h"

namespace seam {
namespace {

/// Impacts told per tick; more are not shown.
constexpr std::size_t kImpactsToldMax = 64;

}  // namespace

Replica::Replica(const Topology& topology, const SyncConfig& config, int self, int own_player)
    : config_(config),
      world_(topology),
      roles_(config_, self, own_player, world_),
      memory_(config_, world_),
      inputs_(topology.scene().players.size()),
      display_(config_, world_, memory_.snapshots()),
      replay_(config_, world_, roles_, memory_, display_, inputs_),
      corrector_(config_, world_, roles_, memory_, display_, replay_, inputs_),
      scheduler_(config_, world_, roles_, memory_),
      proposals_(config_.tick_hz),
      impact_reporter_(world_, roles_),
      pressed_now_(topology.scene().players.size(), 0) {
  corrector_.FollowRoles();
  memory_.Record();
}

void Replica::StartAt(std::int64_t tick) {
  if (tick == world_.tick()) return;
  world_.SetTick(tick);
  memory_.StartAnew();
  replay_.Forget();
  memory_.Record();
}

void Replica::Step() {
  ApplyEdits();
  const std::int64_t next = tick() + 1;
  replay_.Run();
  ApplyInputs(next);
  display_.Drive(next);
  corrector_.PullCopies();
  world_.Step();
  memory_.NoteContacts(roles_.table());
  impact_reporter_.Note();
  for (Edit& edit : world_.ProposeEdits()) {
    if (roles_.Proposes(edit)) proposals_.Add(std::move(edit), tick());
  }
  scheduler_.Collect();
  memory_.Record();
  replay_.TakeBarrier();
  display_.Glide();
  corrector_.ReceiveWaiting();
}

void Replica::ApplyInputs(std::int64_t next) {
  for (std::size_t p = 0; p < inputs_.size(); ++p) {
    const int player = static_cast<int>(p);
    if (config_.mode == Mode::kOracle) {
      inputs_[p].Note(next, ScriptedInput(world_.scene(), player, next));
    }
    world_.SetInput(player, inputs_[p].At(next));
    const std::int16_t pressed = inputs_[p].TakePresses(next);
    pressed_now_[p] |= pressed;
    ApplyPresses(player, pressed, next);
  }
}

/// Exactly one peer pushes: the authority, when it hears of it (all of them in the oracle).
void Replica::ApplyPresses(int player, int pressed, std::int64_t next) {
  const Composition& composition = world_.composition();
  const std::vector<Action>& actions =
      world_.scene().players[static_cast<std::size_t>(player)].actions;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (((pressed >> actions[a].button) & 1) == 0) continue;
    const int assembly = composition.assembly_of_part[static_cast<std::size_t>(actions[a].part)];
    if (assembly < 0) continue;  // the part has left
    const int m = composition.assemblies[static_cast<std::size_t>(assembly)].mechanism;
    const bool alone = config_.mode == Mode::kOracle;
    if (!alone && (m < 0 || !roles_.IsAuthority(m))) continue;
    world_.Act(player, static_cast<int>(a));
    replay_.NoteAction(next, player, static_cast<int>(a));
  }
}

std::vector<int> Replica::ApplyGrants(const Grants& grants) {
  ApplyEdits();  // the grants are about what is there after them
  std::vector<int> let_go = roles_.Apply(grants);
  // Before motion follows the roles: what the holder last simulated.
  for (ExactStates& exact : MakeExact(let_go, 0)) released_.push_back(std::move(exact));
  corrector_.FollowRoles();
  return let_go;
}

void Replica::ReleaseAll() {
  roles_.ReleaseAll();
  corrector_.FollowRoles();
}

Received Replica::Receive(const States& states) {
  ApplyEdits();
  return corrector_.Receive(states);
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
    if (impact.dv < kMajorImpact || out.id_a.size() >= kImpactsToldMax) continue;
    out.id_a.push_back(
        static_cast<std::int16_t>(impact.body_a < 0 ? -1 : world_.id(impact.body_a)));
    out.id_b.push_back(
        static_cast<std::int16_t>(impact.body_b < 0 ? -1 : world_.id(impact.body_b)));
    out.x.push_back(impact.point.x());
    out.y.push_back(impact.point.y());
    out.dv.push_back(impact.dv);
  }
  return out;
}

}  // namespace seam
