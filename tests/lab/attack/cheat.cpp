#include "tests/lab/attack/cheat.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/scene/mechanism_ids.h"
#include "common/scene/ownership.h"
#include "common/scene/part_rules.h"
#include "common/sync/edits/edit_order.h"
#include "tests/lab/attack/silent_net.h"
#include "tests/support/path/rewriting_net.h"

namespace seam {
namespace {

PackedMotion MotionOf(const Scene& scene) {
  return PackedMotion(scene.gravity.x(), scene.gravity.y(), scene.solver.tick_hz);
}

void Shift(double x, double y, WireBody* body) {
  body->x += static_cast<std::uint32_t>(static_cast<std::int32_t>(x * kQuantaPerMetre));
  body->y += static_cast<std::uint32_t>(static_cast<std::int32_t>(y * kQuantaPerMetre));
}

std::int16_t Speed(double mps) {
  return static_cast<std::int16_t>(std::clamp(mps, -119.0, 119.0) * kQuantaPerSpeed);
}

double MpsOf(std::int16_t quanta) { return static_cast<double>(quanta) / kQuantaPerSpeed; }

/// The way in x since `from`, m.
double WayX(const WireBody& body, const WireBody& from) {
  return static_cast<double>(static_cast<std::int32_t>(body.x - from.x)) / kQuantaPerMetre;
}

}  // namespace

const std::vector<std::string>& AttackNames() {
  static const std::vector<std::string> names = {
      "none",    "silence", "firstword", "x1.05", "x1.2",     "x1.5",    "speed1.2",
      "ram",     "vel10",   "fly",       "lift",  "freeze",   "tear",    "spin",
      "rest",    "exact",   "impact",    "break", "withhold", "gain0.1", "gain0.2",
      "gain0.5", "gain5",   "bounce1.2", "pulse", "part",     "wheel",   "gaps"};
  return names;
}

Cheat::Cheat(const std::string& attack, const Scene& scene)
    : scene_(scene), attack_(attack), honest_(MotionOf(scene)), lying_(MotionOf(scene)) {
  const Composition composition = Compose(scene);
  const int m = MechanismIn(composition, scene.players.front().vehicle);
  if (m >= 0) EachIdOf(composition, m, [this](PartId id) { car_.push_back(id); });
  for (std::size_t id = 0; id < scene.parts.size(); ++id) {
    if (scene.parts[id].name == "ann-wheel.0") wheel_ = static_cast<std::int32_t>(id);
  }
  ChooseLies(attack);
}

bool Cheat::IsCar(std::int32_t id) const {
  return std::binary_search(car_.begin(), car_.end(), id);
}

void Cheat::ChooseLies(const std::string& attack) {
  const auto& names = AttackNames();
  if (std::find(names.begin(), names.end(), attack) == names.end()) {
    throw OperatorError("no attack \"" + attack + "\"");
  }
  const auto first = [this](const WireBody& body) -> const WireBody& { return first_.at(body.id); };
  const auto factor = [first, this](double f, bool speed) -> Change {
    return [=](std::int64_t, WireBody* body) {
      if (!IsCar(body->id)) return true;
      Shift((f - 1) * WayX(*body, first(*body)), 0, body);
      if (speed) body->vx = Speed(f * MpsOf(body->vx));
      return true;
    };
  };
  if (attack == "x1.05") change_ = factor(1.05, false);
  if (attack == "x1.2" || attack == "gaps") change_ = factor(1.2, false);
  if (attack == "part" || attack == "wheel") {
    change_ = [this, faster = factor(1.2, false)](std::int64_t tick, WireBody* body) {
      const auto turn = static_cast<std::size_t>(attack_ == "part" ? tick / 2 : 1);
      return faster(tick, body) && body->id != car_[turn % car_.size()];
    };
  }
  if (attack == "x1.5") change_ = factor(1.5, false);
  if (attack == "speed1.2") change_ = factor(1.2, true);
  if (attack == "gain0.1") change_ = Gain(0.1);
  if (attack == "gain0.2") change_ = Gain(0.2);
  if (attack == "gain0.5") change_ = Gain(0.5);
  if (attack == "gain5" || attack == "pulse") change_ = Gain(5);
  if (attack == "bounce1.2") change_ = Bounce(1.2);
  if (attack == "silence") {
    change_ = [this](std::int64_t tick, WireBody* body) {
      if (!IsCar(body->id)) return true;
      if (tick < start_tick_ + 216) return false;
      Shift(400, 0, body);
      return true;
    };
  }
  if (attack == "firstword") {
    start_tick_ = 0;
    change_ = [](std::int64_t, WireBody* body) { return Shift(400, 1, body), true; };
  }
  if (attack == "ram") {
    change_ = [this](std::int64_t tick, WireBody* body) {
      if (!IsCar(body->id)) return true;
      Shift(std::min(40.0, 6.9 * static_cast<double>(tick - start_tick_)), 0, body);
      body->vx = Speed(119);
      return true;
    };
  }
  if (attack == "vel10") {
    change_ = [](std::int64_t, WireBody* body) {
      body->vx = Speed(10 * MpsOf(body->vx)), body->vy = Speed(10 * MpsOf(body->vy));
      return true;
    };
  }
  if (attack == "fly" || attack == "freeze") {
    const double up = attack == "fly" ? 21 : 0;
    change_ = [=](std::int64_t, WireBody* body) {
      if (!IsCar(body->id)) return true;
      body->x = first(*body).x, body->y = first(*body).y, body->angle = first(*body).angle;
      body->vx = body->vy = body->spin = 0;
      Shift(0, up, body);
      return true;
    };
  }
  if (attack == "lift") {
    change_ = [this](std::int64_t, WireBody* body) {
      if (IsCar(body->id)) Shift(0, 2, body);
      return true;
    };
  }
  if (attack == "tear") {
    change_ = [this](std::int64_t, WireBody* body) {
      if (body->id == wheel_) Shift(-4, 0, body);
      return true;
    };
  }
  if (attack == "spin") {
    change_ = [](std::int64_t, WireBody* body) { return body->spin = Speed(90), true; };
  }
  if (attack == "impact") {
    change_ = [this](std::int64_t, WireBody* body) {
      if (!IsCar(body->id)) body->vx = Speed(110);
      return true;
    };
  }
}

Cheat::Change Cheat::Gain(double rate) {
  return [this, rate](std::int64_t tick, WireBody* body) {
    if (!IsCar(body->id)) return true;
    Ahead& ahead = ahead_[body->id];
    const double speed = MpsOf(body->vx);
    const double s = ahead.tick < 0 ? 0 : static_cast<double>(tick - ahead.tick) / 60;
    if (std::fabs(speed) > 0.5) ahead.speed += (speed > 0 ? rate : -rate) * s;
    ahead.way += ahead.speed * s;
    ahead.tick = tick;
    Shift(ahead.way, 0, body);
    body->vx = Speed(speed + ahead.speed);
    return true;
  };
}

Cheat::Change Cheat::Bounce(double share) {
  return [this, share](std::int64_t tick, WireBody* body) {
    if (!IsCar(body->id)) return true;
    Ahead& ahead = ahead_[body->id];
    const double speed = MpsOf(body->vx), blow = speed - ahead.was;
    const double s = ahead.tick < 0 ? 0 : static_cast<double>(tick - ahead.tick) / 60;
    if (ahead.tick >= 0 && std::fabs(blow) > 1) ahead.speed += (share - 1) * blow;
    ahead.way += ahead.speed * s;
    ahead.tick = tick;
    ahead.was = speed;
    Shift(ahead.way, 0, body);
    body->vx = Speed(speed + ahead.speed);
    return true;
  };
}

void Cheat::NoteLie(std::int64_t tick) {
  ++lies_;
  if (first_tick_ < 0) first_tick_ = tick;
}

std::unique_ptr<Net> Cheat::Around(std::unique_ptr<Net> net) {
  if (attack_ == "pulse") net = std::make_unique<SilentNet>(std::move(net));
  return std::make_unique<RewritingNet>(std::move(net), [this](std::int64_t, Bytes* message) {
    Rewrite(message);
    return true;
  });
}

void Cheat::Rewrite(Bytes* message) {
  const AnyMessage any = Decode(*message);
  if (const auto* packed = std::get_if<PackedStates>(&any)) {
    RewriteStates(message, *packed);
  } else if (const auto* inputs = std::get_if<PackedInputs>(&any)) {
    if (attack_ == "gaps" && tick_ >= start_tick_) LeaveOutInputs(message, *inputs);
  } else if (tick_ >= start_tick_) {
    RewriteOther(message);
  }
}

void Cheat::RewriteStates(Bytes* message, const PackedStates& packed) {
  const std::vector<States>* const all = honest_.Take(packed);
  if (all == nullptr) return;
  for (const States& states : *all) {
    const StatesHeader header = HeaderOf(states);
    tick_ = std::max(tick_, states.tick);
    revision_ = states.revision;
    std::vector<WireBody> bodies;
    for (std::size_t i = 0; i < states.id.size(); ++i) {
      WireBody body = BodyAt(states, i);
      const bool lies = change_ && states.tick >= start_tick_;
      if (lies) first_.emplace(body.id, body);
      if (lies) NoteLie(states.tick);
      if (!lies || change_(states.tick, &body)) bodies.push_back(body);
    }
    lying_.Add(header, bodies.data(), bodies.data() + bodies.size());
  }
  // Nothing is acknowledged to this packer, so that it tells whole states.
  const std::vector<StatesPacker::Message> told = lying_.Take(0);
  *message = told.empty() ? Encode(Ping()) : Encode(told.front().packed);
}

/// Those of each eighth tick. A message tells of successive ticks: those after the gap.
void Cheat::LeaveOutInputs(Bytes* message, const PackedInputs& packed) {
  const std::optional<std::vector<Inputs>> all = UnpackInputs(packed);
  for (const Inputs& inputs : all.value()) {
    const std::int64_t newest =
        inputs.first_tick + static_cast<std::int64_t>(inputs.drive.size()) - 1;
    const auto told = static_cast<std::size_t>(newest % 8);
    InputsPacker packer;
    if (told > 0) packer.Add(inputs, told);
    *message = told > 0 ? Encode(packer.Finish()) : Encode(Ping());
  }
}

void Cheat::RewriteOther(Bytes* message) {
  AnyMessage any = Decode(*message);
  if (auto* rest = std::get_if<Rest>(&any)) {
    if (attack_ != "rest") return;
    for (float& x : rest->x) x += 3;
    for (float& y : rest->y) y += 2;
    NoteLie(rest->tick);
    *message = Encode(*rest);
  } else if (auto* exact = std::get_if<ExactStates>(&any)) {
    if (attack_ == "exact") {
      for (float& x : exact->x) x += 5;
      NoteLie(exact->tick);
      *message = Encode(*exact);
    } else if (attack_ == "withhold") {
      *message = Encode(Ping());
    }
  } else if (std::holds_alternative<Release>(any) && attack_ == "withhold") {
    NoteLie(tick_);
    *message = Encode(Ping());
  } else if (auto* report = std::get_if<ImpactReport>(&any)) {
    if (attack_ != "impact") return;
    for (float& dv : report->dv) dv = 150;
    NoteLie(report->tick);
    *message = Encode(*report);
  } else if (std::holds_alternative<Ping>(any) && attack_ == "break" && ++pings_ % 5 == 0) {
    for (std::size_t j = 0; j < scene_.joints.size(); ++j) {
      if (scene_.joints[j].kind != JointKind::kGlue) continue;
      const Edit edit(BreakEdit{static_cast<std::int32_t>(j)}, EditCause::kPhysics);
      EditOrder proposal = ToOrder(edit);
      proposal.number = -1;
      proposal.tick = tick_;
      proposal.sequence = revision_;
      NoteLie(tick_);
      *message = Encode(proposal);
      return;
    }
  }
}

}  // namespace seam
