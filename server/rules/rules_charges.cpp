/// Rules: detonates charges at their time, or once a body has entered their trigger.

#include <cmath>

#include "common/physics/part_places.h"
#include "common/scene/charges/charge.h"
#include "server/rules/rules.h"
#include "server/script/script_host.h"

namespace seam {
namespace {

constexpr std::int64_t kNotYet = INT64_MAX, kSetOff = -1;  // values of charge_due_

std::int64_t Ticks(double seconds, int tick_hz) {
  return static_cast<std::int64_t>(std::llround(seconds * tick_hz));
}

}  // namespace

void Rules::RunCharges() {
  const int tick_hz = scene().solver.tick_hz;
  if (charge_due_.empty()) {
    for (const Charge& charge : scene().charges) {
      charge_due_.push_back(charge.trigger < 0 ? Ticks(charge.at_s, tick_hz) : kNotYet);
    }
  }
  for (std::size_t c = 0; c < charge_due_.size(); ++c) {
    const Charge& charge = scene().charges[c];
    std::int64_t& due = charge_due_[c];
    for (const TriggerEvent& event : happened_) {
      if (due != kNotYet || !event.entered || event.trigger != charge.trigger) continue;
      due = world_.tick() + Ticks(charge.delay_s, tick_hz);
    }
    if (due == kSetOff || due > world_.tick()) continue;
    due = kSetOff;
    SetOff(charge);
  }
}

void Rules::SetOff(const Charge& charge) {
  Vec2 centre = charge.position;
  if (charge.part >= 0) {
    BodyState state;
    if (!ReadPart(world_, charge.part, &state)) return;
    centre += state.position;
  }
  try {
    Blast({centre, charge.radius, charge.speed, charge.impulse});
    Event event = MakeEvent(EventKind::kTrigger, charge.name + " goes off");
    event.body = charge.part;
    commands_.Say(event);
  } catch (const ScriptRefusal& refusal) {
    commands_.Warn("charge " + charge.name + " does not go off: " + refusal.what());
  }
}

void Rules::Blast(const BlastEdit& blast) {
  commands_.Blast(blast.centre, blast.radius, blast.speed, blast.impulse);
  violence_.blasts.push_back(blast);
}

}  // namespace seam
