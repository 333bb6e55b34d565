#pragma once
/// A small session made by hand, for tests of the renderer: two carts that meet on a floor, a
/// wheel and a stack, as the server and two players see them. No physics is simulated: the truth
/// is a formula, the views are the truth some ticks late.

#include <algorithm>
#include <cmath>

#include "common/codec/codec.h"
#include "common/measure/measure.h"
#include "common/record/log_file.h"
#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {
namespace synthetic {

constexpr int kTicks = 180;
constexpr int kHitTick = 75;

inline Part MakeBox(PartId id, const std::string& name, Vec2 at, Vec2 size) {
  Part part;
  part.id = id;
  part.name = name;
  part.position = at;
  part.size = size;
  return part;
}

/// Parts: 0 floor, 1 ann's cart, 2 ben's cart, 3 a wheel, 4..7 a stack.
inline Scene MakeScene() {
  Scene scene;
  scene.name = "synthetic";
  scene.title = "Two carts meet";
  scene.duration_s = kTicks / 60.0;
  scene.parts.push_back(MakeBox(0, "floor", {0, -0.5f}, {60, 1}));
  scene.parts[0].anchored = true;
  scene.parts.push_back(MakeBox(1, "cart_a", {-10, 0.75f}, {3, 1.5f}));
  scene.parts.push_back(MakeBox(2, "cart_b", {10, 0.75f}, {3, 1.5f}));
  scene.parts.push_back(MakeBox(3, "wheel", {-14, 0.8f}, {1, 1}));
  scene.parts[3].kind = ShapeKind::kCircle;
  scene.parts[3].radius = 0.8f;
  for (int i = 0; i < 4; ++i)
    scene.parts.push_back(
        MakeBox(4 + i, "box" + std::to_string(i), {14, 0.5f + static_cast<float>(i)}, {1, 1}));
  const char* const names[] = {"ann", "ben"};
  for (int p = 0; p < 2; ++p) {
    Player player;
    player.name = names[p];
    player.vehicle = 1 + p;
    player.has_region = true;
    player.region_min = Vec2(p == 0 ? -40.0f : 0.0f, -10);
    player.region_max = Vec2(p == 0 ? 0.0f : 40.0f, 30);
    scene.players.push_back(player);
  }
  scene.buffer_m = 6;
  scene.camera.given = true;
  scene.camera.min = {-18, -2};
  scene.camera.max = {18, 10};
  scene.watch.push_back({{1, 2}, 30});
  return scene;
}

/// Returns a body's pose at a tick: carts run at 8 m/s, touch at kHitTick and go back at 5 m/s.
inline BodyState Truth(PartId id, double tick) {
  const Scene scene = MakeScene();
  BodyState state;
  state.position = scene.parts[static_cast<std::size_t>(id)].position;
  const double t = std::max(tick, 0.0) / 60.0, hit = kHitTick / 60.0;
  if (id == 1 || id == 2) {
    const double run = t < hit ? 6.8 * t : 6.8 * hit - 5 * (t - hit);
    state.position.x() += static_cast<float>(id == 1 ? run : -run);
    state.angle = static_cast<float>((id == 1 ? 0.15 : -0.15) * std::max(0.0, t - hit));
    state.velocity.x() = (id == 1 ? 1.0f : -1.0f) * (t < hit ? 6.8f : -5.0f);
  }
  if (id == 3) {
    state.position.x() += static_cast<float>(3 * t);
    state.angle = static_cast<float>(-3 * t / 0.8);
    state.velocity.x() = 3;
  }
  return state;
}

inline Oracle MakeOracle() {
  Oracle oracle;
  for (PartId id = 1; id < 8; ++id) oracle.ids.push_back(id);
  for (int tick = 0; tick <= kTicks; ++tick) {
    oracle.ticks.emplace_back();
    for (PartId id : oracle.ids) oracle.ticks.back().push_back(Truth(id, tick));
  }
  return oracle;
}

/// Views of peers 0 (server), 1 and 2; other players' carts are displayed `late_ticks` late.
inline Recording MakeRecording(int late_ticks, const std::string& mode = "buffer",
                               const std::string& reconcile = "interleave") {
  Recording recording;
  recording.room.room = "test";
  recording.room.scene_name = "synthetic";
  recording.room.mode = mode;
  recording.room.reconcile = reconcile;
  recording.room.impair = "demo";
  recording.room.seed = 1;
  recording.last_tick = kTicks;
  for (int peer = 0; peer < 3; ++peer) {
    for (int tick = 0; tick <= kTicks; ++tick) {
      View view;
      view.peer = peer;
      view.tick = tick;
      for (PartId id = 1; id < 8; ++id) {
        const int owner = id == 1 || id == 3 ? 1 : id == 2 ? 2 : 0;
        const bool near = std::abs(Truth(id, tick).position.x()) < 6;
        const BodyState state = Truth(id, owner == peer ? tick : tick - late_ticks);
        view.id.push_back(static_cast<std::int32_t>(id));
        view.role.push_back(owner == peer ? kRoleAuthority : near ? kRoleSecondary : kRoleRemote);
        view.authority.push_back(static_cast<std::int8_t>(owner));
        view.x.push_back(state.position.x());
        view.y.push_back(state.position.y());
        view.angle.push_back(state.angle);
        view.vx.push_back(state.velocity.x());
        view.vy.push_back(state.velocity.y());
        view.spin.push_back(state.spin);
        view.age.push_back(0);
      }
      recording.views[peer][tick] = view;
    }
    Impacts impacts;
    impacts.peer = peer;
    impacts.tick = kHitTick;
    impacts.id_a = {1};
    impacts.id_b = {2};
    impacts.x = {0};
    impacts.y = {0.75f};
    impacts.dv = {11.8f};
    recording.impacts.push_back(impacts);
    if (peer == 0) continue;
    Stats stats;
    stats.peer = peer;
    stats.rtt_us = 104000;
    stats.jitter_us = 9000;
    recording.stats[peer].push_back(stats);
  }
  return recording;
}

/// Lets the views of MakeRecording(late_ticks) say that they show others so long ago.
inline void SayAges(int late_ticks, Recording* recording) {
  for (auto& [peer, views] : recording->views)
    for (auto& [tick, view] : views)
      for (std::size_t i = 0; i < view.id.size(); ++i)
        view.age[i] = view.authority[i] == peer ? 0 : static_cast<float>(late_ticks);
}

/// Returns the same scene as the text of a scene file.
inline std::string SceneText() {
  return R"(title = "Two carts meet"
duration = 3
buffer = 6
[[part]]
name = "floor"
chain = [[-30, 0], [30, 0]]
[[part]]
name = "cart_a"
box = [3, 1.5]
position = [-10, 0.75]
[[part]]
name = "cart_b"
box = [3, 1.5]
position = [10, 0.75]
[[part]]
name = "wheel"
circle = 0.8
position = [-14, 0.8]
[[part]]
name = "box"
box = [1, 1]
position = [14, 0.5]
repeat = {count = 4, step = [0, 1]}
[[player]]
name = "ann"
vehicle = "cart_a"
region = [[-40, -10], [-0.001, 30]]
[[player]]
name = "ben"
vehicle = "cart_b"
region = [[0, -10], [40, 30]]
[[watch]]
struck = ["cart_a", "cart_b"]
around = 0.5
[camera]
min = [-18, -2]
max = [18, 10]
)";
}

/// Returns the oracle's recording: the truth without any delay.
inline Recording MakeOracleRecording() {
  Recording recording = MakeRecording(0, "oracle", "");
  recording.views.erase(1);
  recording.views.erase(2);
  return recording;
}

/// Writes a recording as the log of a session, in the order of time.
inline void WriteLog(const std::string& path, Recording recording) {
  recording.room.scene_text = SceneText();
  LogWriter log(path);
  log.Publish(ChannelName("test", "room"), 0, Encode(recording.room));
  std::int32_t sequence = 0;
  for (int tick = 0; tick <= kTicks; ++tick) {
    const std::int64_t utime = tick * 1000000LL / 60;
    for (auto& [peer, views] : recording.views) {
      views[tick].sequence = tick + 1;
      log.Publish(ChannelName("test", "view", peer), utime, Encode(views[tick]));
    }
    for (Impacts& impacts : recording.impacts) {
      if (impacts.tick != tick) continue;
      impacts.sequence = ++sequence;
      log.Publish(ChannelName("test", "impacts", impacts.peer), utime, Encode(impacts));
    }
  }
}

}  // namespace synthetic
}  // namespace seam
