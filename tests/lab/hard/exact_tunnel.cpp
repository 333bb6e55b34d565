/// Shots of 10 to 1000 m/s at a wall of 6 cm, anchored or moving: how many get through.

#include <algorithm>
#include <cmath>

#include "tests/lab/hard/exact_judge.h"

namespace seam {
namespace {

/// Of the speed that a shot was fired with: slower before the wall, and the engine's clamp of 2 m
/// a step did it.
constexpr double kSlowed = 0.999;
/// m/s
constexpr int kSpeeds[] = {10, 20, 50, 100, 120, 200, 500, 1000};

/// Shots are the parts "shot-…", each of which flies along x at what lies ahead of it in its lane,
/// the part "wall-…" of the same ending, or else the part "wall".
class TunnelJudge : public Judge {
 public:
  explicit TunnelJudge(const Scene& scene) {
    for (const Part& part : scene.parts) {
      if (part.name.rfind("shot-", 0) != 0) continue;
      Shot shot;
      shot.body = BodyOf(scene, part.id);
      shot.speed = static_cast<double>(part.velocity.x());
      const std::string ahead = "wall-" + part.name.substr(5);
      for (const Part& wall : scene.parts) {
        if (wall.name != ahead && wall.name != "wall") continue;
        shot.wall = wall.anchored ? -1 : BodyOf(scene, wall.id);
        shot.wall_x = static_cast<double>(wall.position.x());
        if (wall.name == ahead) break;
      }
      shots_.push_back(shot);
    }
  }

  void See(const World& world) override {
    for (Shot& shot : shots_) {
      const double x = Place(world, shot.body).x();
      const double wall = shot.wall < 0 ? shot.wall_x : Place(world, shot.wall).x();
      // Not the instant of the blow: what is stuck in the wall may yet be pushed back.
      shot.through = x > wall;
      shot.met = shot.met || x + kNear > wall;
      if (!shot.met && Speed(world, shot.body).x() < kSlowed * shot.speed) shot.slowed = true;
      if (std::isnan(x)) lost_ = true;
    }
  }

  double Error() const override {
    if (lost_) return std::nan("");
    return static_cast<double>(Count(&Shot::through)) / static_cast<double>(shots_.size());
  }

  std::string Failure() const override {
    const int slowed = Count(&Shot::slowed);
    if (slowed == 0) return "";
    return std::to_string(slowed) + " of " + std::to_string(shots_.size()) +
           " shots slowed by the engine's clamp";
  }

 private:
  /// m; nearer than this to the wall a lower speed may be the blow's doing.
  static constexpr double kNear = 0.5;

  struct Shot {
    int body = 0, wall = -1;  ///< -1: anchored
    double wall_x = 0;        ///< m, at tick 0
    double speed = 0;         ///< m/s, as fired
    bool met = false, through = false, slowed = false;
  };

  int Count(bool Shot::*what) const {
    return static_cast<int>(
        std::count_if(shots_.begin(), shots_.end(), [&](const Shot& s) { return s.*what; }));
  }

  std::vector<Shot> shots_;
  bool lost_ = false;
};

/// What the wall must not miss of a shot's way in one step, m. Bullets: the engine's clamp. Others
/// meet a moving wall only where a step ends: half of the shot's 20 cm and the wall's 6 cm.
constexpr double kBulletStep = 2, kPlainStep = 0.13;
/// m/s; the moving walls come towards the shots.
constexpr double kWallSpeed = 1;

/// Every shot of the scene at this speed, and the fewest steps a second that hold it. (The speeds
/// are above what a scene may say: its limit is the clamp at 60 Hz.)
std::function<void(Scene*)> Fire(int speed, bool bullet) {
  return [speed, bullet](Scene* scene) {
    for (Part& part : scene->parts) {
      if (part.name.rfind("shot-", 0) != 0) continue;
      part.velocity = Vec2(static_cast<float>(speed), 0);
      part.bullet = bullet;
    }
    const double steps = bullet ? speed / kBulletStep : (speed + kWallSpeed) / kPlainStep;
    const int steps_hz = static_cast<int>(std::ceil(steps));
    Solver& solver = scene->solver;
    while (solver.tick_hz * 32 < steps_hz) solver.tick_hz *= 2;
    solver.substeps = std::max(1, (steps_hz + solver.tick_hz - 1) / solver.tick_hz);
  };
}

HardCase Shooting(int speed, bool bullet) {
  const std::string number = std::to_string(speed);
  const std::string kind = bullet ? "bullet" : "plain";
  return {"tunnel-" + kind + "-" + std::string(4 - number.size(), '0') + number,
          "tunnel",
          Truth::kFormula,
          "1",
          "share of discs and boxes, " + std::string(bullet ? "" : "no ") +
              "bullets, that get through 6 cm at " + number + " m/s",
          2,
          MakeJudge<TunnelJudge>,
          Fire(speed, bullet)};
}

}  // namespace

std::vector<HardCase> TunnelCases() {
  std::vector<HardCase> cases;
  for (const bool bullet : {true, false}) {
    for (const int speed : kSpeeds) cases.push_back(Shooting(speed, bullet));
  }
  return cases;
}

}  // namespace seam
