#include "common/sync/show/joint_closer.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/geometry.h"

namespace seam {
namespace {

/// What is off by centimetres takes a few sweeps; a chain of a dozen links that is off by half a
/// metre everywhere takes about a hundred. What is left after these is seen as an open joint.
constexpr int kRoundsMax = 120;
/// A pin between two bodies of a list.
struct Hold {
  const Pin* pin = nullptr;
  std::size_t a = 0, b = 0;  // indices into the list
};

/// A mechanism's bodies in these poses, then what its pins are anchored to.
struct Assembled {
  std::vector<PinnedBody> list;
  std::vector<BodyState> states;  // of the same
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

/// Whole turns by which the angle between two bodies is off the range that a pin allows it; 0 where
/// that is a turn or more.
float TurnsBeyond(const Pin& pin, float angle_a, float angle_b) {
  const float middle = (pin.angle_lower + pin.angle_upper) / 2;
  if (pin.angle_upper - pin.angle_lower >= 2 * kPiFloat) return 0;
  return std::round((angle_b - angle_a - middle) / (2 * kPiFloat));
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
    for (std::size_t i = 0; i < left.size(); ++i) {
      // To and fro, or what is off travels along a chain only a link a sweep.
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
