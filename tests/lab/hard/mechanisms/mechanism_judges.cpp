#include "tests/lab/hard/mechanisms/mechanism_judges.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/measure/energy.h"
#include "common/measure/joint_drift.h"
#include "common/measure/overlap.h"
#include "tests/lab/hard/exact_judge.h"

namespace seam {
namespace {

class JointDriftJudge final : public Watch {
 public:
  JointDriftJudge(const WatchLimits& limits, double tear_m, const Journey& journey,
                  const Scene& scene)
      : Watch(limits), meter_(scene, Compose(scene)), tear_m_(tear_m), journey_(journey) {
    if (!journey.part.empty()) body_ = BodyOf(scene, PartNamed(scene, journey.part).id);
  }

  std::string Failure() const override {
    const std::string other = Watch::Failure();
    if (!other.empty() || body_ < 0 || begin_ < 0) return other;
    const Vec2 way = now_ - from_;
    const bool there = way.x() >= journey_.at_least.x() && way.y() >= journey_.at_least.y();
    return there ? "" : "did not get there";
  }

 protected:
  void Look(const World& world, double t) override {
    const double drift = meter_.Worst(states(), world.tick());
    if (begin_ < 0) {
      begin_ = drift;
      if (body_ >= 0) from_ = states()[static_cast<std::size_t>(body_)].position;
    }
    worst_m_ = std::max(worst_m_, drift - begin_);
    if (drift - begin_ > tear_m_) Fail("came apart", t);
    if (body_ >= 0) now_ = states()[static_cast<std::size_t>(body_)].position;
  }
  double Value() const override { return worst_m_; }

 private:
  const JointMeter meter_;
  const double tear_m_;
  const Journey journey_;
  int body_ = -1;
  Vec2 from_{0, 0}, now_{0, 0};
  double begin_ = -1, worst_m_ = 0;
};

class OverlapJudge final : public Watch {
 public:
  OverlapJudge(const WatchLimits& limits, double from_s, const Scene& scene)
      : Watch(limits), meter_(scene, Compose(scene)), from_s_(from_s) {}

 protected:
  void Look(const World& world, double t) override {
    tick_ = world.tick();
    if (t < from_s_) return;
    late_ = true;
    worst_m_ = std::max(worst_m_, meter_.Deepest(states(), tick_));
  }
  double Value() const override { return late_ ? worst_m_ : meter_.Deepest(states(), tick_); }

 private:
  const OverlapMeter meter_;
  const double from_s_;
  std::int64_t tick_ = 0;
  bool late_ = false;
  double worst_m_ = 0;
};

class EnergyJudge final : public Watch {
 public:
  EnergyJudge(const WatchLimits& limits, const Scene& scene)
      : Watch(limits), meter_(scene, Compose(scene)) {}

 protected:
  void Look(const World& world, double) override {
    const double now = meter_.Of(states(), world.tick());
    if (!begun_) begin_ = now;
    begun_ = true;
    worst_ = Worse(worst_, std::fabs(now / begin_ - 1));
  }
  double Value() const override { return worst_; }

 private:
  const EnergyMeter meter_;
  bool begun_ = false;
  double begin_ = 0, worst_ = 0;
};

class GripJudge final : public Watch {
 public:
  GripJudge(const WatchLimits& limits, const Grip& grip, const Scene& scene)
      : Watch(limits),
        grip_(grip),
        load_(BodyOf(scene, PartNamed(scene, grip.load).id)),
        jaw_(BodyOf(scene, PartNamed(scene, grip.jaw).id)) {}

  std::string Failure() const override {
    const std::string other = Watch::Failure();
    if (!other.empty() || !begun_) return other;
    return height_ - height_begin_ < grip_.lift_m ? "is not up" : "";
  }

 protected:
  void Look(const World&, double t) override {
    const BodyState& load = states()[static_cast<std::size_t>(load_)];
    const BodyState& jaw = states()[static_cast<std::size_t>(jaw_)];
    height_ = static_cast<double>(load.position.y());
    if (!begun_) height_begin_ = height_;
    begun_ = true;
    const Eigen::Vector2d held =
        Turned((load.position - jaw.position).cast<double>(), -static_cast<double>(jaw.angle));
    if (!closed_) held_ = held;
    closed_ = closed_ || t >= grip_.from_s;
    slip_m_ = std::max(slip_m_, (held - held_).norm());
    if (slip_m_ > grip_.loose_m) Fail("slipped out", t);
  }
  double Value() const override { return slip_m_; }

 private:
  const Grip grip_;
  const int load_, jaw_;
  bool begun_ = false, closed_ = false;
  Eigen::Vector2d held_{0, 0};  // in the jaw's frame, when the grip was closed
  double height_ = 0, height_begin_ = 0, slip_m_ = 0;
};

}  // namespace

std::unique_ptr<Judge> MakeJointDriftJudge(const WatchLimits& limits, double tear_m,
                                           const Journey& journey, const Scene& scene) {
  return std::make_unique<JointDriftJudge>(limits, tear_m, journey, scene);
}

std::unique_ptr<Judge> MakeOverlapJudge(const WatchLimits& limits, double from_s,
                                        const Scene& scene) {
  return std::make_unique<OverlapJudge>(limits, from_s, scene);
}

std::unique_ptr<Judge> MakeEnergyJudge(const WatchLimits& limits, const Scene& scene) {
  return std::make_unique<EnergyJudge>(limits, scene);
}

std::unique_ptr<Judge> MakeGripJudge(const WatchLimits& limits, const Grip& grip,
                                     const Scene& scene) {
  return std::make_unique<GripJudge>(limits, grip, scene);
}

}  // namespace seam
