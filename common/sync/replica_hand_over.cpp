/// Replica: exact states of mechanisms that change hands.

#include <algorithm>
#include <map>

#include "common/scene/mechanism_ids.h"
#include "common/sync/replica.h"

namespace seam {

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
    if (body < 0 || world_.motion(body) != Motion::kDynamic) continue;
    if (states.revision != revision()) continue;
    const BodyState* then = memory_.ComparablePast(body, states.tick);
    if (then != nullptr) call(body, Minus(Unpack(states, i, then->angle), *then));
  }
}

}  // namespace seam
