#include "common/sync/show/joint_closer.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/geometry.h"

namespace seam {
namespace {

/// Limit of sweeps. Errors of centimetres take a few; a chain of a dozen links that is off by half
/// a metre everywhere takes about a hundred. The rest stays visible as an open joint.
constexpr int kRoundsMax = 120;
/// Sweeps that weight bodies by mass. Later sweeps treat all bodies alike, and bodies that pins
/// keep from turning only shift: a light body between heavy or anchored ones would otherwise only
/// move or turn to and fro.
constexpr int kRoundsByMass = 20;
/// Stands for the inertia of an anchored body, kg m2.
constexpr float kAnchored = 1e12f;
/// A pin between two bodies of a list.
struct Hold {
  const Pin* pin = nullptr;
  std::size_t a = 0, b = 0;  // indices into the list
};

/// A mechanism's bodies at given poses, followed by the anchored ends of its pins.
struct Assembled {
  std::vector<PinnedBody> list;
  std::vector<BodyState> states;  // of list, in the same order
  std::vector<Hold> holds;

  template <class PoseOf>
  Assembled(const World& world, const std::vector<int>& bodies, const std::vector<Pin>& pins,
            const PoseOf& pose_of) {
    list.reserve(bodies.size() + 2 * pins.size());
    states.reserve(list.capacity());
    holds.reserve(pins.size());
    const auto add = [&](const BodyState& state, const MassPoint& mass) {
      list.emplace_back(state, mass);
      states.push_back(state);
    };
    for (const int body : bodies) add(pose_of(body), world.mass_point(body));
    const auto index = [&](const PinEnd& end) {
      if (end.body >= 0) {
        const auto at = std::lower_bound(bodies.begin(), bodies.end(), end.body);
        return static_cast<std::size_t>(at - bodies.begin());
      }
      add(world.ReadAssembly(end.assembly), MassPoint{});
      return list.size() - 1;
    };
    for (const Pin& pin : pins) {
      Hold hold;
      hold.pin = &pin;
      hold.a = index(pin.a);
      hold.b = index(pin.b);
      holds.push_back(hold);
    }
  }
  PinGap Gap(std::size_t hold) const {
    return GapOf(*holds[hold].pin, list[holds[hold].a], list[holds[hold].b]);
  }
};

/// Returns the whole turns by which the angle between two bodies is off the pin's range; 0 if that
/// range is a turn or more.
float TurnsBeyond(const Pin& pin, float angle_a, float angle_b) {
  const float middle = (pin.angle_lower + pin.angle_upper) / 2;
  if (pin.angle_upper - pin.angle_lower >= 2 * kPiFloat) return 0;
  return std::round((angle_b - angle_a - middle) / (2 * kPiFloat));
}

bool KeepsTurn(const Pin& pin) { return !pin.by_distance && pin.angle_lower == pin.angle_upper; }

/// Turns bodies that pins keep from turning against each other to their average angle, or to that
/// of an anchored body among them, and fixes their angles.
void HoldTurns(const std::vector<Hold>& holds, std::vector<PinnedBody>* list) {
  std::vector<char> held(list->size(), 0);
  struct Member {
    std::size_t body = 0;
    float wants = 0;  // rad: its angle less the first one's
  };
  for (std::size_t first = 0; first < list->size(); ++first) {
    if (held[first]) continue;
    std::vector<Member> group = {{first, 0}};
    held[first] = 1;
    for (std::size_t next = 0; next < group.size(); ++next) {
      const Member member = group[next];
      for (const Hold& hold : holds) {
        const bool from_a = hold.a == member.body;
        const std::size_t other = from_a ? hold.b : hold.a;
        if (!KeepsTurn(*hold.pin) || (!from_a && hold.b != member.body) || held[other]) continue;
        held[other] = 1;
        const float turn = hold.pin->angle_lower;
        group.push_back({other, member.wants + (from_a ? turn : -turn)});
      }
    }
    if (group.size() < 2) continue;
    const float angle = (*list)[first].angle;
    const auto off = [&](const Member& member) {
      return WrapAngle((*list)[member.body].angle - member.wants - angle);
    };
    float sum = 0, weights = 0;
    for (const Member& member : group) {
      const PinnedBody& body = (*list)[member.body];
      const float weight = body.inverse_inertia > 0 ? 1 / body.inverse_inertia : kAnchored;
      sum += weight * off(member);
      weights += weight;
    }
    for (const Member& member : group) {
      PinnedBody& body = (*list)[member.body];
      if (body.inverse_mass <= 0) continue;
      body.angle += sum / weights - off(member);
      body.inverse_inertia = 0;
      body.moved = true;
    }
  }
}

Assembled InWorld(const World& world, const std::vector<int>& bodies,
                  const std::vector<Pin>& pins) {
  return Assembled(world, bodies, pins, [&](int body) { return world.Read(body); });
}

}  // namespace

void JointCloser::Rebuild() {
  mechanisms_.assign(world_.composition().mechanisms.size(), {});
  for (int body = 0; body < world_.body_count(); ++body) {
    mechanisms_[static_cast<std::size_t>(world_.mechanism(body))].bodies.push_back(body);
  }
  for (const Pin& pin : world_.Pins()) {
    const int body = pin.a.body >= 0 ? pin.a.body : pin.b.body;
    Jointed& jointed = mechanisms_[static_cast<std::size_t>(world_.mechanism(body))];
    jointed.pins.push_back(pin);
    jointed.sprung = jointed.sprung || pin.swing > 0 || pin.turn_swing > 0;
    jointed.anchored = jointed.anchored || pin.a.body < 0 || pin.b.body < 0;
  }
}

void JointCloser::Unwind(int mechanism, std::vector<BodyState>* poses) const {
  const Jointed& jointed = At(mechanism);
  if (jointed.pins.empty()) return;
  std::vector<int> known = {jointed.bodies.front()};
  const auto is_known = [&](int body) {
    return std::find(known.begin(), known.end(), body) != known.end();
  };
  for (bool more = true; more;) {
    more = false;
    for (const Pin& pin : jointed.pins) {
      if (pin.a.body < 0 || pin.b.body < 0 || is_known(pin.a.body) == is_known(pin.b.body))
        continue;
      float& a = (*poses)[static_cast<std::size_t>(pin.a.body)].angle;
      float& b = (*poses)[static_cast<std::size_t>(pin.b.body)].angle;
      const float turns = TurnsBeyond(pin, a, b) * 2 * kPiFloat;
      const bool moves_b = is_known(pin.a.body);
      (moves_b ? b : a) += moves_b ? -turns : turns;
      known.push_back(moves_b ? pin.b.body : pin.a.body);
      more = true;
    }
  }
}

void JointCloser::Close(int mechanism, bool simulated, std::vector<BodyState>* poses) const {
  Close(At(mechanism).bodies, At(mechanism).pins, simulated, poses);
}

void JointCloser::CloseMovedOn(int mechanism, const std::vector<BodyState>& from,
                               std::vector<BodyState>* poses) const {
  const Jointed& jointed = At(mechanism);
  if (!jointed.sprung) return Close(jointed.bodies, jointed.pins, false, poses);
  const Assembled then(world_, jointed.bodies, jointed.pins,
                       [&](int body) { return from[static_cast<std::size_t>(body)]; });
  std::vector<Pin> narrowed = jointed.pins;
  for (std::size_t i = 0; i < narrowed.size(); ++i) {
    const std::size_t a = then.holds[i].a, b = then.holds[i].b;
    narrowed[i] = Within(narrowed[i], then.list[a], then.states[a], then.list[b], then.states[b]);
  }
  Close(jointed.bodies, narrowed, false, poses);
}

void JointCloser::Close(const std::vector<int>& bodies, const std::vector<Pin>& pins,
                        bool simulated, std::vector<BodyState>* poses) const {
  SEAM_ASSERT(static_cast<int>(poses->size()) == world_.body_count());
  Assembled shown(world_, bodies, pins,
                  [&](int body) { return (*poses)[static_cast<std::size_t>(body)]; });
  std::vector<PinLeft> left(pins.size());
  if (simulated) {
    const Assembled real = InWorld(world_, bodies, pins);
    for (std::size_t i = 0; i < left.size(); ++i) {
      const PinGap gap = real.Gap(i);
      left[i] = {gap.excess, gap.turn};
    }
  }
  bool open = true;
  for (int round = 0; open && round < kRoundsMax; ++round) {
    open = false;
    if (round == kRoundsByMass) {
      HoldTurns(shown.holds, &shown.list);
      for (PinnedBody& body : shown.list) body.MakeAlike();
    }
    for (std::size_t i = 0; i < left.size(); ++i) {
      // Alternates the direction; otherwise an error travels along a chain only one link per sweep.
      const std::size_t at = round % 2 == 0 ? i : left.size() - 1 - i;
      const Hold& hold = shown.holds[at];
      open = ClosePin(*hold.pin, left[at], &shown.list[hold.a], &shown.list[hold.b]) || open;
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const PinnedBody& body = shown.list[i];
    if (!body.moved) continue;
    BodyState& pose = (*poses)[static_cast<std::size_t>(bodies[i])];
    pose.position = body.ToWorld(Vec2(0, 0));
    pose.angle = body.angle;
  }
}

}  // namespace seam
