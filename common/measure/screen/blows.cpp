#include "common/measure/screen/blows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/measure/screen/thresholds.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// Duration of an impact, and the gap before and after it at which velocity changes are compared to
/// distinguish the impact from a lasting force, ticks.
constexpr std::int64_t kBlowTicks = 2, kBlowAround = 2;
/// Greatest lead and lag of a view against the oracle, s.
constexpr double kEarly = 0.1, kLate = 1.0;
/// Greatest gap of touching bodies, m.
constexpr double kTouchingGap = 0.1;
constexpr std::int64_t kNeverTick = std::numeric_limits<std::int64_t>::max() / 2;

/// Returns the velocity in the step that leads to `tick`, m/s.
Vector2d Velocity(const BodyPath& path, std::int64_t tick, double h) {
  return (path.At(tick).position - path.At(tick - 1).position) / h;
}

}  // namespace

void Blows::Begin(PartId id, const BodyPath& truth, double radius) {
  begin_ = blows_.size();
  const auto change = [&](std::int64_t tick) -> Vector2d {
    return Velocity(truth, tick + kBlowTicks, h_) - Velocity(truth, tick, h_);
  };
  const std::int64_t reach = kBlowTicks + kBlowAround;
  for (std::int64_t tick = truth.first() + reach + 1; tick + 2 * reach <= truth.last(); ++tick) {
    if (!truth.Whole(tick - reach - 1, tick + 2 * reach)) continue;
    const Vector2d dv = change(tick);
    const double usual = std::max(change(tick - reach).norm(), change(tick + reach).norm());
    if (dv.norm() < kBlowMin + usual) continue;
    if (change(tick + 1).norm() > dv.norm()) continue;  // the impact is still beginning
    Blow blow;
    blow.id = id;
    blow.tick = tick + 1;
    blow.position = truth.At(tick + 1).position;
    blow.before = Velocity(truth, tick, h_);
    blow.change = dv;
    blow.radius = radius;
    tick += reach;
    const std::optional<std::int64_t> due = Answer(blow, truth);
    if (!due) continue;  // the next impact reverses this one
    blow.answer_due = *due;
    blows_.push_back(std::move(blow));
  }
}

std::optional<std::int64_t> Blows::Answer(const Blow& blow, const BodyPath& path) const {
  const Vector2d way = blow.change.normalized();
  const double due = blow.change.norm() / 2;
  const auto early = static_cast<std::int64_t>(std::llround(kEarly / h_));
  const auto late = static_cast<std::int64_t>(std::llround(kLate / h_));
  for (std::int64_t tick = blow.tick - early; tick <= blow.tick + late; ++tick) {
    if (!path.Whole(tick - 1, tick + 1)) continue;
    // Over two ticks: a jump that is undone in the next tick is no response.
    const Vector2d v = (path.At(tick + 1).position - path.At(tick - 1).position) / (2 * h_);
    if ((v - blow.before).dot(way) >= due) return tick;
  }
  return std::nullopt;
}

void Blows::Show(int peer, const ShownBody& body) {
  for (std::size_t b = begin_; b < blows_.size(); ++b) {
    Blow& blow = blows_[b];
    if (!body.shown.Has(blow.tick)) continue;
    const std::optional<std::int64_t> answer = Answer(blow, body.shown);
    blow.late[peer] = answer ? *answer - blow.answer_due : kNeverTick;
  }
}

void Blows::Notice(BodySeconds* seconds) const {
  std::vector<const Blow*> order;
  for (const Blow& blow : blows_) order.push_back(&blow);
  std::stable_sort(order.begin(), order.end(),
                   [](const Blow* a, const Blow* b) { return a->tick < b->tick; });
  const auto delay = static_cast<std::int64_t>(std::floor(kContactDelay / h_ + 1e-9));
  // Marks `a` for each peer on whose screen it responds later than `b`.
  const auto compare = [&](const Blow& a, const Blow& b) {
    for (const auto& [peer, late] : a.late) {
      const auto other = b.late.find(peer);
      if (other == b.late.end() || late <= other->second + delay) continue;
      seconds->Notice(peer, a.id, b.answer_due + other->second + delay);
    }
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = i + 1; k < order.size() && order[k]->tick <= order[i]->tick + 1; ++k) {
      const Blow &a = *order[i], &b = *order[k];
      const double apart = (a.position - b.position).norm();
      if (a.id == b.id || apart > a.radius + b.radius + kTouchingGap) continue;
      compare(a, b);
      compare(b, a);
    }
  }
}

}  // namespace seam
