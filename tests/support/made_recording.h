#pragma once
/// Recordings made by hand: one moving body and one that stands still, displayed without error.

#include <cstdint>
#include <functional>
#include <utility>

#include "common/measure/measure.h"

namespace seam {

constexpr int kHz = 64;  // ticks are exact in binary
constexpr double kH = 1.0 / kHz;

/// A body as a function of the tick.
using Path = std::function<BodyState(std::int64_t)>;

/// Makes a state from its numbers: m, m, m/s, m/s, rad.
inline BodyState State(double x, double y, double vx = 0, double vy = 0, double angle = 0) {
  BodyState state;
  state.position = Vec2(static_cast<float>(x), static_cast<float>(y));
  state.velocity = Vec2(static_cast<float>(vx), static_cast<float>(vy));
  state.angle = static_cast<float>(angle);
  return state;
}

/// Returns a motion along x at `speed`.
inline Path Moving(double speed) {
  return [speed](std::int64_t tick) {
    return State(speed * kH * static_cast<double>(tick), 1, speed, 0);
  };
}

/// Returns a view of bodies 3 and 7; body 7 stands still. By default peer 0 has authority.
inline View MakeView(int peer, std::int64_t tick, const BodyState& body) {
  View view;
  view.peer = peer;
  view.tick = tick;
  for (const auto& [id, state] : {std::pair{3, body}, std::pair{7, State(-5, 0)}}) {
    view.id.push_back(static_cast<std::int32_t>(id));
    view.role.push_back(peer == 0 ? kRoleAuthority : kRoleSecondary);
    view.authority.push_back(0);
    view.x.push_back(state.position.x());
    view.y.push_back(state.position.y());
    view.angle.push_back(state.angle);
    view.vx.push_back(state.velocity.x());
    view.vy.push_back(state.velocity.y());
    view.spin.push_back(state.spin);
    view.age.push_back(0);
  }
  return view;
}

/// A scene in which bodies 3 and 7 are balls without gravity.
constexpr const char* kTwoBalls = R"(
gravity = [0, 0]
[[part]]
name = "far"
box = [1, 1]
position = [90, 90]
anchored = true
repeat = {count = 3, step = [2, 0]}
[[part]]
name = "three"
circle = 0.5
[[part]]
name = "farther"
box = [1, 1]
position = [90, 95]
anchored = true
repeat = {count = 3, step = [2, 0]}
[[part]]
name = "seven"
circle = 0.5
position = [-5, 0]
)";

/// Returns the views of `peers` peers that all show `motion`, from tick 0 to `last_tick`.
inline Recording MakeRecording(int peers, std::int64_t last_tick, const Path& motion) {
  Recording recording;
  recording.room.tick_hz = kHz;
  recording.room.mode = "oracle";
  for (int peer = 0; peer < peers; ++peer) {
    for (std::int64_t tick = 0; tick <= last_tick; ++tick) {
      recording.views[peer][tick] = MakeView(peer, tick, motion(tick));
    }
  }
  recording.first_tick = 0;
  recording.last_tick = last_tick;
  return recording;
}

/// Returns the oracle's recording of `motion`.
inline Oracle MakeOracle(std::int64_t last_tick, const Path& motion) {
  return OracleFromRecording(MakeRecording(1, last_tick, motion));
}

}  // namespace seam
