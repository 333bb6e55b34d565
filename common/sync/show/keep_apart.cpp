/// Keeps what is displayed of different moments from overlapping.

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>

#include "common/sync/show/show_age.h"

namespace seam {
namespace {

/// Depth by which displayed bodies may overlap, beyond their overlap now, m: less than the measures
/// take for noticed (kOverlapFloor). Every centimetre less makes moments jump more often.
constexpr float kUnseenDepth = 0.045f;
/// Step in which a moment is looked for, ticks.
constexpr double kMomentStep = 0.25;

/// Returns the radius about a body's position in which its shapes are, m.
float Radius(const World& world, int body) {
  const auto [low, high] = world.Bounds(body);
  return (high - low).norm() / 2 + ((high + low) / 2 - world.Read(body).position).norm();
}

/// A body of a mechanism that pushes others.
struct Pusher {
  int body = -1;
  BodyState pose;
  float radius = 0;
};

}  // namespace

void KeepApart(const World& world, double oldest,
               const std::function<BodyState(int body, double moment)>& pose_at,
               std::vector<ShownMechanism>* shown) {
  std::vector<float> radii(static_cast<std::size_t>(world.body_count()), -1);  // scratch, by body
  const auto radius_of = [&](int body) {
    float& radius = radii[static_cast<std::size_t>(body)];
    if (radius < 0) radius = Radius(world, body);
    return radius;
  };
  // Returns the first moment from `moment`, at most `latest`, at which the body is clear of `a`.
  const auto clear_from = [&](const Pusher& a, int b, double moment, double latest) {
    const float reach = a.radius + radius_of(b);
    std::optional<float> now;
    for (; moment < latest; moment = std::min(moment + kMomentStep, latest)) {
      const BodyState pose = pose_at(b, moment);
      if ((pose.position - a.pose.position).squaredNorm() > reach * reach) return moment;
      const float depth = world.OverlapAt(a.body, a.pose, b, pose);
      if (depth <= kUnseenDepth) return moment;
      if (!now) now = world.OverlapAt(a.body, world.Read(a.body), b, world.Read(b));
      if (depth <= *now + kUnseenDepth) return moment;
    }
    return moment;
  };
  std::deque<std::size_t> pushing;
  for (std::size_t i = 0; i < shown->size(); ++i) {
    if ((*shown)[i].moment > oldest) pushing.push_back(i);
  }
  // It ends: each mechanism comes back only with a later moment, by kMomentStep or up to another's.
  for (std::vector<Pusher> pushers; !pushing.empty(); pushing.pop_front()) {
    const ShownMechanism& from = (*shown)[pushing.front()];
    pushers.clear();
    for (const int body : *from.bodies) {
      pushers.push_back({body, pose_at(body, from.moment), radius_of(body)});
    }
    for (std::size_t i = 0; i < shown->size(); ++i) {
      ShownMechanism& other = (*shown)[i];
      const double before = other.moment;
      for (const Pusher& pusher : pushers) {
        for (const int body : *other.bodies) {
          if (other.moment >= from.moment) break;
          other.moment = clear_from(pusher, body, other.moment, from.moment);
        }
      }
      if (other.moment > before) pushing.push_back(i);
    }
  }
}

}  // namespace seam
