#include "render/scene_recording.h"

#include "common/physics/world.h"
#include "common/sync/method.h"
#include "common/sync/replica.h"

namespace seam {
namespace {

/// Returns the player with the region that contains a point; -1: none.
int PlayerAt(const Scene& scene, const Vec2& at) {
  for (std::size_t p = 0; p < scene.players.size(); ++p) {
    const Player& player = scene.players[p];
    const bool in =
        (at - player.region_min).minCoeff() >= 0 && (player.region_max - at).minCoeff() >= 0;
    if (player.has_region && in) return static_cast<int>(p);
  }
  return -1;
}

}  // namespace

bool IsSceneFile(const std::string& path) {
  const std::string ending = ".toml";
  return path.size() > ending.size() &&
         path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}

Recording RecordingOfScene(const std::string& path) {
  const Scene scene = LoadScene(path);
  SyncConfig config = MakeSyncConfig(MethodNames{"central", "", ""});
  config.tick_hz = scene.solver.tick_hz;
  const Replica replica(scene, config, 0, -1);
  View view = replica.MakeView();
  const World& world = replica.world();
  for (std::size_t i = 0; i < view.id.size(); ++i) {
    const int body = world.BodyOfId(view.id[i]);
    const auto mechanism = static_cast<std::size_t>(world.mechanism(body));
    const Mechanism& of = world.composition().mechanisms[mechanism];
    const int owner =
        of.owner >= 0 ? of.owner : PlayerAt(scene, world.Read(world.BodyOfId(of.id)).position);
    view.authority[i] = static_cast<std::int16_t>(owner + 1);
  }
  Recording recording;
  Room& room = recording.room;
  room.scene_name = scene.name;
  room.scene_text = scene.text;
  room.mode = "central";
  room.impair = "perfect";
  room.tick_hz = scene.solver.tick_hz;
  recording.views[0][0] = view;
  recording.first_tick = recording.last_tick = 0;
  return recording;
}

}  // namespace seam
