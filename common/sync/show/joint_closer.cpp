#include "common/sync/show/joint_closer.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "common/base/check.h"
#include "common/base/geometry.h"

namespace seam {
namespace {

/// What is off by centimetres takes a few sweeps; a chain of a dozen links that is off by half a
/// metre everywhere takes about a hundred. What is left after these is seen as an open joint.
constexpr int kRoundsMax = 120;
/// What the engine leaves open of a joint is believed up to kSlackStart at once, and beyond that as
/// it grows by kSlackPerTick, m and rad: a load opens joints slowly, a correction in a tick.
constexpr float kSlackStart = 0.003f, kSlackPerTick = 0.001f;

float Followed(float slack, float open) {
  return slack + std::clamp(open - slack, -kSlackPerTick, kSlackPerTick);
}

/// A pin between two bodies of a list.
struct Hold {
  const Pin* pin = nullptr;
  std::size_t a = 0, b = 0;  // indices into the list
};

/// A mechanism's bodies in these poses, then what its pins are anchored to.
struct Assembled {
  std::vector<PinnedBody> list;
  std::vector<Hold> holds;

  template <class PoseOf>
  Assembled(const World& world, const std::vector<int>& bodies, const std::vector<Pin>& pins,
            const PoseOf& pose_of) {
    for (const int body : bodies) list.emplace_back(pose_of(body), world.mass_point(body));
    const auto index = [&](const PinEnd& end) {
      if (end.body >= 0) {
        const auto at = std::lower_bound(bodies.begin(), bodies.end(), end.body);
        return static_cast<std::size_t>(at - bodies.begin());
      }
      list.emplace_back(world.ReadAssembly(end.assembly), MassPoint{});
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

Assembled InWorld(const World& world, const std::vector<int>& bodies,
                  const std::vector<Pin>& pins) {
  return Assembled(world, bodies, pins, [&](int body) { return world.Read(body); });
}

/// What may stay of what the engine left open.
PinLeft LeftOf(const PinGap& gap, const PinSlack& slack) {
  PinLeft left;
  const float size = gap.excess.norm();
  left.excess = size > slack.shift ? Vec2(gap.excess * (slack.shift / size)) : gap.excess;
  left.turn = std::clamp(gap.turn, -slack.turn, slack.turn);
  return left;
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
    jointed.anchored = jointed.anchored || pin.a.body < 0 || pin.b.body < 0;
  }
}

void JointCloser::Follow(int mechanism, bool corrected) {
  Jointed& jointed = mechanisms_[static_cast<std::size_t>(mechanism)];
  if (jointed.pins.empty()) return;
  jointed.slacks.resize(jointed.pins.size(), PinSlack{kSlackStart, kSlackStart});
  const Assembled real = InWorld(world_, jointed.bodies, jointed.pins);
  for (std::size_t i = 0; i < jointed.pins.size(); ++i) {
    const PinGap gap = real.Gap(i);
    PinSlack& slack = jointed.slacks[i];
    const float shift = corrected ? 0 : gap.excess.norm();
    const float turn = corrected ? 0 : std::fabs(gap.turn);
    slack.shift = Followed(slack.shift, std::max(kSlackStart, shift));
    slack.turn = Followed(slack.turn, std::max(kSlackStart, turn));
  }
}

void JointCloser::Trust(int mechanism) {
  Jointed& jointed = mechanisms_[static_cast<std::size_t>(mechanism)];
  jointed.slacks.assign(jointed.pins.size(), PinSlack{FLT_MAX, kPiFloat});
}

void JointCloser::Forget(int mechanism) {
  mechanisms_[static_cast<std::size_t>(mechanism)].slacks.clear();
}

void JointCloser::Close(int mechanism, bool simulated, std::vector<BodyState>* poses) const {
  const Jointed& jointed = At(mechanism);
  SEAM_ASSERT(static_cast<int>(poses->size()) == world_.body_count());
  Assembled shown(world_, jointed.bodies, jointed.pins,
                  [&](int body) { return (*poses)[static_cast<std::size_t>(body)]; });
  std::vector<PinLeft> left(jointed.pins.size());
  if (simulated) {
    const Assembled real = InWorld(world_, jointed.bodies, jointed.pins);
    for (std::size_t i = 0; i < left.size(); ++i) {
      const bool followed = !jointed.slacks.empty();
      left[i] =
          LeftOf(real.Gap(i), followed ? jointed.slacks[i] : PinSlack{kSlackStart, kSlackStart});
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
  for (std::size_t i = 0; i < jointed.bodies.size(); ++i) {
    const PinnedBody& body = shown.list[i];
    if (!body.moved) continue;
    BodyState& pose = (*poses)[static_cast<std::size_t>(jointed.bodies[i])];
    pose.position = body.ToWorld(Vec2(0, 0));
    pose.angle = body.angle;
  }
}

}  // namespace seam
