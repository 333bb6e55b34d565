#include <algorithm>
#include <cfloat>

#include "common/base/limits.h"
#include "common/scene/planner/planner_rules.h"
#include "common/scene/scene_draft.h"

namespace seam {
namespace {

/// Largest product of players and fully followed bodies if players start far apart.
constexpr int kFollowedByAll = 4096;

}  // namespace

void ReadPlanner(const SceneReader& root, SceneDraft* draft) {
  const TomlNode* table = root.Table("planner");
  if (table == nullptr) return;
  const SceneReader r(*table, draft->file, "planner",
                      {"acquire", "keep", "dwell", "capacity", "hear"});
  PlannerRules rules;
  const bool more = r.Has("acquire") || r.Has("keep") || r.Has("dwell") || r.Has("capacity");
  rules.given = more || !r.Has("hear");
  rules.hear = r.Number("hear", {60, 100000}, rules.hear);
  rules.acquire = r.Number("acquire", {1, 1000}, rules.acquire);
  rules.keep = r.Number("keep", {1, 2000}, rules.acquire * 1.5f);
  rules.dwell_s = r.Seconds("dwell", {0, 10}, rules.dwell_s);
  rules.capacity = r.Integer("capacity", {0, 65535}, rules.capacity);
  if (rules.keep < rules.acquire) {
    r.FailAt("keep", "keep must be at least acquire (" + Decimal(rules.acquire) +
                         "): otherwise authority would change all the time");
  }
  draft->scene.planner.Set(rules);
}

void LimitFollowing(const SceneReader& root, SceneDraft* draft) {
  Scene& scene = draft->scene;
  if (scene.players.size() > static_cast<std::size_t>(kPlayersFollowingMax)) {
    if (root.Has("follow") && scene.follow_bodies > 0) {
      root.FailAt("follow", "follow must be 0 in a scene of more than " +
                                std::to_string(kPlayersFollowingMax) + " players");
    }
    scene.follow_bodies = 0;
  }
  Vec2 min(FLT_MAX, FLT_MAX), max(-FLT_MAX, -FLT_MAX);
  for (const Player& player : scene.players) {
    if (player.vehicle < 0) continue;
    const Vec2& at = scene.parts[static_cast<std::size_t>(player.vehicle)].position;
    min = min.cwiseMin(at);
    max = max.cwiseMax(at);
  }
  const bool spread = (max - min).maxCoeff() > 2 * scene.planner->hear;
  if (!spread) return;
  const int most = kFollowedByAll / static_cast<int>(scene.players.size());
  if (!root.Has("follow")) scene.follow_bodies = std::min(scene.follow_bodies, most);
  if (!root.Has("server_follow")) scene.server_follow = std::min(scene.server_follow, most);
}

}  // namespace seam
