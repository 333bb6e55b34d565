/// Replica: exact states of mechanisms that change hands, and its whole state as bytes.

#include <algorithm>
#include <map>

#include "common/base/bytes.h"
#include "common/scene/mechanism_ids.h"
#include "common/scene/saved/persist_state.h"
#include "common/sync/edits/edit_order.h"
#include "common/sync/replica.h"

namespace seam {
namespace {

/// Most edits that physics may have found and nobody has ordered yet.
constexpr std::size_t kFoundMost = 1 << 16;

}  // namespace

std::vector<ExactStates> Replica::MakeExact(const std::vector<int>& mechanisms,
                                            std::int32_t epochs_on) const {
  // Every peer writes these states as they are. If a state rested on an assumed input, the effect
  // of the real input would be lost.
  const auto final_tick = [&](int m) {
    if (!config_.policy->SendsCompleteTicks()) return tick();
    const std::int64_t complete = std::min(reach_.CompleteTick(m), replay_.settled());
    bool known = true;
    EachIdOf(world_.composition(), m, [&](PartId id) {
      known = known && memory_.ComparablePast(world_.BodyOfId(id), complete) != nullptr;
    });
    return known ? complete : tick();
  };
  std::map<std::int64_t, std::vector<int>> of_tick;
  for (const int m : mechanisms) of_tick[final_tick(m)].push_back(m);
  std::vector<ExactStates> all;
  const auto add = [&](std::int64_t of, int m, PartId id) {
    if (all.empty() || all.back().tick != of || all.back().id.size() >= kExactBodiesMax) {
      all.emplace_back();
      all.back().tick = of;
      all.back().revision = revision();
    }
    const int body = world_.BodyOfId(id);
    const BodyState state = of == tick() ? world_.Read(body) : *memory_.ComparablePast(body, of);
    ExactStates& out = all.back();
    out.id.push_back(id);
    out.epoch.push_back(roles_.table().at(m).epoch + epochs_on);
    out.x.push_back(state.position.x());
    out.y.push_back(state.position.y());
    out.angle.push_back(state.angle);
    out.vx.push_back(state.velocity.x());
    out.vy.push_back(state.velocity.y());
    out.spin.push_back(state.spin);
  };
  for (const auto& [of, those] : of_tick) {
    for (const int m : those) {
      EachIdOf(world_.composition(), m, [&](PartId id) { add(of, m, id); });
    }
  }
  return all;
}

BodyState Replica::TakeOver(const ExactStates& exact) {
  ApplyEdits();
  const BodyState off = corrector_.TakeOver(exact);
  rest_->ProlongHandedOver(exact);
  return off;
}

void Replica::EachDifference(const States& states,
                             const std::function<void(int, const BodyState&)>& call) const {
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world_.BodyOfId(states.id[i]);
    if (body < 0 || states.revision != revision()) continue;
    const BodyState* then = SettledPast(body, states.tick);
    if (then != nullptr) call(body, Minus(Unpack(states, i, then->angle), *then));
  }
}

void Replica::NoteDivergences(const States& states) {
  if (divergences_ == nullptr || states.tick > tick() || states.peer == roles_.self()) return;
  int missing = 0;
  for (const int player : drivers_.concerned()) {
    missing += inputs_[static_cast<std::size_t>(player)].knows(states.tick) ? 0 : 1;
  }
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world_.BodyOfId(states.id[i]);
    if (body < 0 || states.revision != revision() || !roles_.Simulates(body)) continue;
    if (roles_.table().at(world_.mechanism(body)).authority != states.peer) continue;
    const BodyState* const then = memory_.ComparablePast(body, states.tick);
    if (then == nullptr) continue;
    const BodyState off = Minus(Unpack(states, i, then->angle), *then);
    if (Replay::Agrees(off)) continue;
    divergences_->Note(states.id[i], states.tick, states.peer, off, missing);
  }
}

std::optional<Divergence> Replica::TakeDivergence(std::int64_t now_us) {
  return divergences_ != nullptr ? divergences_->Take(now_us, roles_.self(), tick()) : std::nullopt;
}

const BodyState* Replica::SettledPast(int body, std::int64_t tick) const {
  if (world_.activity(body) != Activity::kSimulated) return nullptr;
  // Before all inputs are known here and acted on, a difference says nothing.
  const std::int64_t complete = reach_.CompleteTick(world_.mechanism(body));
  if (std::min(complete, replay_.settled()) < tick) return nullptr;
  return memory_.ComparablePast(body, tick);
}

const BodyState* Replica::ComparablePast(int body, std::int64_t tick, int revision) const {
  const BodyTrack& track = memory_.track(body);
  // What was simulated from the room's start on began with the scene's own state.
  const bool guess = track.dynamic_since > 0 && track.heard_tick <= track.dynamic_since;
  if (guess || EditHidesPast(body, tick, revision)) return nullptr;
  return SettledPast(body, tick);
}

bool Replica::FollowsTold() const {
  const std::int64_t missed = replay_.missed();
  return missed >= 0 && tick() - missed < kHistory * config_.tick_hz;
}

bool Replica::EditHidesPast(int body, std::int64_t tick, int revision) const {
  const bool old = replay_.missed() >= 0 && memory_.track(body).heard_tick <= replay_.missed();
  return old || replay_.LacksEdit(revision, tick);
}

std::optional<std::uint64_t> Replica::PastHash(std::int64_t tick) const {
  if (tick <= replay_.edited_tick() || tick > newest_past()) return std::nullopt;
  std::uint64_t hash = Fnv1a(&tick, sizeof tick);
  for (int body = 0; body < world_.body_count(); ++body) {
    const BodyState* const then = memory_.history().At(tick, body);
    if (then == nullptr) return std::nullopt;
    const float values[] = {then->position.x(), then->position.y(), then->angle,
                            then->velocity.x(), then->velocity.y(), then->spin};
    hash = Fnv1a(values, sizeof values, hash);
  }
  return hash;
}

void Replica::Persist(StateArchive& a, Past past) {
  const std::int64_t from = past == Past::kAll ? tick() - kHistory * config_.tick_hz : tick();
  WorldSnapshot loaded;
  std::shared_ptr<const WorldSnapshot> now;
  std::vector<char> still(static_cast<std::size_t>(world_.body_count()), 0);
  if (!a.reading()) {
    SEAM_ASSERT(queue_->size() == 0);
    still = memory_.Still();
    if (activities_.NeedAll()) {
      corrector_.FollowRoles();
      world_.Settle();
    }
    now = replay_.BarrierNow();
  }
  replay_.PersistBarriers(a, from);
  if (a.reading()) {
    seam::Persist(a, &loaded);
    now = std::make_shared<const WorldSnapshot>(std::move(loaded));
  } else {
    a.Later([now](StateArchive& out) {
      WorldSnapshot copy = *now;
      seam::Persist(out, &copy);
    });
  }
  a.Section("inputs");
  for (InputTrack& track : inputs_) track.Persist(a);
  if (a.reading() && !LoadWorld(*now, a)) return;
  memory_.Persist(a);
  roles_.table().Persist(a);
  activities_.Persist(a);
  rest_->Persist(a);
  replay_.Persist(a, now);
  PersistEdits(a);
  if (!a.ok()) return;
  if (a.reading()) {
    complete_.StartAt(world_.tick());
    FollowRoles();
    for (int body = 0; body < world_.body_count(); ++body) display_.Reset(body);
  }
  memory_.PersistPast(a, from, still);
  corrector_.Persist(a);
  touches_.Persist(a, world_.scene().parts.size());
  if (config_.policy->SendsCompleteTicks()) reach_.Look();
}

bool Replica::LoadWorld(const WorldSnapshot& now, StateArchive& a) {
  if (!a.ok()) return false;
  // Inputs that go on are no news to a stage: they must not wake bodies.
  for (const int player : drivers_.concerned()) {
    world_.SetInput(player, inputs(player).At(now.tick));
  }
  const Status status = world_.Load(now);
  if (!status.ok()) a.Fail(status.why());
  return status.ok();
}

void Replica::PersistEdits(StateArchive& a) {
  a.Section("edits found");
  const std::size_t parts = world_.scene().parts.size();
  const auto buttons = [&](int* pressed) { a.Int(pressed, INT32_MIN, INT32_MAX); };
  a.Exactly(&pressed_now_, buttons);
  a.Exactly(&pressed_missed_, buttons);
  a.List(&heard_players_, kFoundMost,
         [&](int* p) { a.Int(p, 0, static_cast<std::int64_t>(inputs_.size()) - 1); });
  proposals_.Persist(a);
  a.Entries(
      &found_, kFoundMost, [&](std::int64_t* tick) { a.Tick(tick); },
      [&](std::vector<Edit>* edits) {
        a.List(edits, kFoundMost, [&](Edit* edit) { seam::Persist(a, edit); });
      });
  a.List(&awaited_, kFoundMost, [&](Awaited* awaited) {
    for (std::int32_t& each : awaited->key) a.Int(&each, INT32_MIN, INT32_MAX);
    a.List(&awaited->parts, kFoundMost,
           [&](PartId* part) { a.Int(part, 0, static_cast<std::int64_t>(parts) - 1); });
    a.Tick(&awaited->tick);
  });
}

}  // namespace seam
