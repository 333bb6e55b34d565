/// Replica: what changes hands, bit for bit.

#include "common/sync/replica.h"

#include "common/scene/mechanism_ids.h"

namespace seam {

std::vector<ExactStates> Replica::MakeExact(const std::vector<int>& mechanisms,
                                            std::int32_t epochs_on) const {
  std::vector<ExactStates> all;
  for (const int m : mechanisms) {
    EachIdOf(world_.composition(), m, [&](PartId id) {
      if (all.empty() || all.back().id.size() >= kExactBodiesMax) {
        all.emplace_back();
        all.back().tick = tick();
        all.back().revision = revision();
      }
      const BodyState state = world_.Read(world_.BodyOfId(id));
      ExactStates& out = all.back();
      out.id.push_back(id);
      out.epoch.push_back(roles_.table().at(m).epoch + epochs_on);
      out.x.push_back(state.position.x());
      out.y.push_back(state.position.y());
      out.angle.push_back(state.angle);
      out.vx.push_back(state.velocity.x());
      out.vy.push_back(state.velocity.y());
      out.spin.push_back(state.spin);
    });
  }
  return all;
}

BodyState Replica::TakeOver(const ExactStates& exact) {
  ApplyEdits();
  const BodyState off = corrector_.TakeOver(exact);
  rest_.NoteHandedOver(exact);
  return off;
}

void Replica::EachOff(const States& states,
                      const std::function<void(int, const BodyState&)>& call) const {
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world_.BodyOfId(states.id[i]);
    if (body < 0 || world_.motion(body) != Motion::kDynamic) continue;
    if (states.revision != revision()) continue;
    const BodyState* then = memory_.ComparablePast(body, states.tick);
    if (then != nullptr) call(body, Minus(Unpack(states, i, then->angle), *then));
  }
}

}  // namespace seam
