#include "tests/lab/hard/invariant_far.h"

#include <algorithm>

namespace seam {
namespace {

class FarJudge final : public Watch {
 public:
  FarJudge(const WatchLimits& limits, double away_m, const Vec2& by)
      : Watch(limits), away_m_(away_m), by_(by) {}

 protected:
  void Look(const World& world, double t) override {
    if (!near_) {
      // From the text: the far scene moved back would keep what was rounded far away.
      Scene scene = ParseScene(world.scene().text, world.scene().name);
      scene.solver = world.scene().solver;
      near_ = std::make_unique<World>(scene);
      begin_ = states();
    }
    while (near_->tick() < world.tick()) near_->Step();
    for (int body = 0; body < world.body_count(); ++body) {
      const auto i = static_cast<std::size_t>(body);
      const Eigen::Vector2d far = states()[i].position.cast<double>() - by_.cast<double>();
      worst_m_ = std::max(worst_m_, (far - near_->Read(body).position.cast<double>()).norm());
      const double away = static_cast<double>((states()[i].position - begin_[i].position).norm());
      if (away > away_m_) Fail("fell", t);
    }
  }
  double Value() const override { return worst_m_; }

 private:
  const double away_m_;
  const Vec2 by_;
  std::unique_ptr<World> near_;
  std::vector<BodyState> begin_;
  double worst_m_ = 0;
};

}  // namespace

void ShiftScene(const Vec2& by, Scene* scene) {
  for (Part& part : scene->parts) part.position += by;
  for (Joint& joint : scene->joints) {
    joint.anchor_a += by;
    joint.anchor_b += by;
  }
  scene->bounds_min += by;
  scene->bounds_max += by;
  scene->camera.min += by;
  scene->camera.max += by;
}

std::unique_ptr<Judge> MakeFarJudge(const WatchLimits& limits, double away_m, const Vec2& by) {
  return std::make_unique<FarJudge>(limits, away_m, by);
}

}  // namespace seam
