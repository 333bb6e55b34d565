#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/measure/overlap.h"
#include "tests/lab/hard/invariant_judges.h"

namespace seam {
namespace {

/// How fast bodies moved in the last tick.
class MoveJudge : public Watch {
 public:
  using Watch::Watch;

 protected:
  void Look(const World& world, double t) final {
    const int hz = world.scene().solver.tick_hz;
    if (!before_.empty()) {
      speeds_mps_.resize(states().size());
      for (std::size_t body = 0; body < states().size(); ++body) {
        const Vec2 moved = states()[body].position - before_[body].position;
        speeds_mps_[body] = static_cast<double>(moved.norm()) * hz;
      }
      Judged(speeds_mps_, t);
    }
    before_ = states();
  }
  virtual void Judged(const std::vector<double>& speeds_mps, double t) = 0;

 private:
  std::vector<BodyState> before_;
  std::vector<double> speeds_mps_;
};

class RestlessJudge final : public MoveJudge {
 public:
  RestlessJudge(const WatchLimits& limits, double from_s) : MoveJudge(limits), from_s_(from_s) {}

 protected:
  void Judged(const std::vector<double>& speeds_mps, double t) override {
    if (!counts_) sum_ = count_ = 0;
    counts_ = t > from_s_;
    for (const double speed : speeds_mps) sum_ += speed * speed;
    count_ += static_cast<double>(speeds_mps.size());
  }
  double Value() const override { return count_ > 0 ? std::sqrt(sum_ / count_) : 0; }

 private:
  const double from_s_;
  bool counts_ = false;  ///< this tick and those after it
  double sum_ = 0;       ///< of squares, (m/s)^2
  double count_ = 0;
};

class ReleaseJudge final : public MoveJudge {
 public:
  ReleaseJudge(const WatchLimits& limits, double overlap_m, const Scene& scene)
      : MoveJudge(limits), overlap_m_(overlap_m), meter_(scene, Compose(scene)) {}

  std::string Failure() const override {
    const std::string other = MoveJudge::Failure();
    if (!other.empty()) return other;
    const double overlap = meter_.Deepest(states());
    return overlap > overlap_m_ ? fmt::format("still overlap by {:.2g} m", overlap) : "";
  }

 protected:
  void Judged(const std::vector<double>& speeds_mps, double) override {
    for (const double speed : speeds_mps) fastest_mps_ = std::max(fastest_mps_, speed);
  }
  double Value() const override { return fastest_mps_; }

 private:
  const double overlap_m_;
  const OverlapMeter meter_;
  double fastest_mps_ = 0;
};

class ArrivalJudge final : public Watch {
 public:
  ArrivalJudge(const WatchLimits& limits, const Arrival& arrival, const Scene& scene)
      : Watch(limits), arrival_(arrival) {
    for (const Part& part : scene.parts) {
      if (part.name == arrival.part) part_ = part.id;
    }
    SEAM_ASSERT(part_ >= 0);
  }

 protected:
  void Look(const World& world, double t) override {
    const int body = world.BodyOfId(part_);
    SEAM_ASSERT(body >= 0);
    const Vec2& at = states()[static_cast<std::size_t>(body)].position;
    const double height = static_cast<double>(at.y());
    // Until it must be there, the last height counts: of a run that ends before.
    if (t <= arrival_.from_s) worst_m_ = 0;
    worst_m_ = std::max(worst_m_, std::fabs(height - arrival_.height_m));
    if (t > arrival_.from_s && worst_m_ > arrival_.sink_m) Fail("is not up", t);
  }
  double Value() const override { return worst_m_; }

 private:
  const Arrival arrival_;
  PartId part_ = -1;
  double worst_m_ = 0;
};

}  // namespace

std::unique_ptr<Judge> MakeRestlessJudge(const WatchLimits& limits, double from_s) {
  return std::make_unique<RestlessJudge>(limits, from_s);
}

std::unique_ptr<Judge> MakeReleaseJudge(const WatchLimits& limits, double overlap_m,
                                        const Scene& scene) {
  return std::make_unique<ReleaseJudge>(limits, overlap_m, scene);
}

std::unique_ptr<Judge> MakeArrivalJudge(const WatchLimits& limits, const Arrival& arrival,
                                        const Scene& scene) {
  return std::make_unique<ArrivalJudge>(limits, arrival, scene);
}

}  // namespace seam
