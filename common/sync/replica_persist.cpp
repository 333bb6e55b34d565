/// Replica: its state as bytes.

#include <string>

#include "common/scene/persist_state.h"
#include "common/sync/edits/edit_order.h"
#include "common/sync/replica.h"

namespace seam {
namespace {

/// Most edits that physics may have found and nobody has ordered yet.
constexpr std::size_t kFoundMost = 1 << 16;

}  // namespace

void Replica::Persist(StateArchive& a) {
  WorldSnapshot now;
  if (!a.reading()) {
    SEAM_ASSERT(queued_.empty());
    memory_.UnparkAll();
    if (presence_.NeedAll()) {
      corrector_.FollowRoles();
      world_.Settle();
    }
    now = replay_.BarrierNow();
  }
  seam::Persist(a, &now);
  a.Section("inputs");
  for (InputTrack& track : inputs_) track.Persist(a);
  if (a.reading() && !LoadWorld(now, a)) return;
  memory_.Persist(a);
  roles_.table().Persist(a);
  presence_.Persist(a);
  rest_.Persist(a);
  replay_.Persist(a, now);
  PersistEdits(a);
  if (!a.ok()) return;
  if (a.reading()) {
    FollowRoles();
    for (int body = 0; body < world_.body_count(); ++body) display_.Reset(body);
  }
  if (config_.rolls_back) reach_.Look();
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
    a.List(&awaited->parts, kFoundMost, [&](PartId* part) {
      a.Int(part, 0, static_cast<std::int64_t>(parts) - 1);
    });
    a.Tick(&awaited->tick);
  });
}

}  // namespace seam
