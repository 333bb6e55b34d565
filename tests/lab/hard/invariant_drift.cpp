#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/lab/hard/invariant_judges.h"

namespace seam {
namespace {

class DriftJudge : public Watch {
 public:
  DriftJudge(const WatchLimits& limits, const DriftLimits& drift) : Watch(limits), drift_(drift) {}

 protected:
  void Look(const World&, double t) override {
    if (begin_.empty()) begin_ = settled_ = states();
    if (!has_settled_ && t >= drift_.settle_s) {
      settled_ = states();
      has_settled_ = true;
      worst_m_ = 0;
    }
    for (std::size_t body = 0; body < states().size(); ++body) {
      const Vec2& now = states()[body].position;
      worst_m_ = std::max(worst_m_, Counted(now - settled_[body].position));
      const double away = static_cast<double>((now - begin_[body].position).norm());
      if (away > drift_.away_m) Fail("fell", t);
    }
  }
  double Value() const override { return worst_m_; }

  const std::vector<BodyState>& begin() const { return begin_; }

 private:
  double Counted(const Vec2& moved) const {
    const bool all = drift_.across == Vec2(0, 0);
    return static_cast<double>(all ? moved.norm() : std::fabs(moved.dot(drift_.across)));
  }

  const DriftLimits drift_;
  std::vector<BodyState> begin_, settled_;
  bool has_settled_ = false;
  double worst_m_ = 0;
};

class ToppleJudge final : public DriftJudge {
 public:
  using DriftJudge::DriftJudge;

  std::string Failure() const override {
    const std::string other = DriftJudge::Failure();
    if (!other.empty()) return other;
    std::size_t lying = 0;
    for (std::size_t body = 0; body < states().size(); ++body) {
      if (std::fabs(states()[body].angle - begin()[body].angle) > kLyingRad) ++lying;
    }
    if (lying == states().size()) return "";
    return fmt::format("the wave stopped: {} of {} fell", lying, states().size());
  }

 private:
  static constexpr float kLyingRad = 0.5f;
};

}  // namespace

std::unique_ptr<Judge> MakeDriftJudge(const WatchLimits& limits, const DriftLimits& drift) {
  return std::make_unique<DriftJudge>(limits, drift);
}

std::unique_ptr<Judge> MakeToppleJudge(const WatchLimits& limits, const DriftLimits& drift) {
  return std::make_unique<ToppleJudge>(limits, drift);
}

}  // namespace seam
