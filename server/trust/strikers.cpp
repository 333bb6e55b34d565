#include "server/trust/strikers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/physics/part_places.h"
#include "common/sync/reach/zones.h"
#include "server/rules/impact_check.h"

namespace seam {
namespace {

/// Most that a collision gives, in speeds of the striker: a heavy elastic one.
constexpr float kMostThrown = 2;
/// Moments before and after now at which the motion of a part on a path is looked at, each.
constexpr int kMoverLooks = 10;

}  // namespace

Strikers::Strikers(const World& world, std::function<float(int)> speed_of)
    : world_(world), speed_of_(std::move(speed_of)) {}

void Strikers::Look() {
  const int revision = world_.topology().revision();
  if (looked_ == world_.tick() && revision_ == revision) return;
  looked_ = world_.tick();
  if (std::exchange(revision_, revision) != revision) movers_.reset();
  const Composition& c = world_.composition();
  std::vector<MovingBox> boxes;
  for (int body = 0; body < world_.body_count(); ++body) {
    const int assembly = c.assembly_of_part[static_cast<std::size_t>(world_.id(body))];
    const Vec2 reach =
        Vec2::Constant(ExtentOf(world_, c.assemblies[static_cast<std::size_t>(assembly)]) +
                       speed_of_(body) * kSeconds);
    const Vec2 at = world_.Read(body).position;
    MovingBox box;
    box.min = at - reach, box.max = at + reach;
    box.group = world_.mechanism(body);
    boxes.push_back(box);
  }
  island_ = Components(static_cast<int>(c.mechanisms.size()), MeetingGroups(boxes, 0));
  fastest_.assign(c.mechanisms.size(), Fastest());
  momentum_.assign(c.mechanisms.size(), 0);
  mass_ = momentum_;
  for (int body = 0; body < world_.body_count(); ++body) {
    const auto own =
        static_cast<std::size_t>(island_[static_cast<std::size_t>(world_.mechanism(body))]);
    const float speed = speed_of_(body);
    fastest_[own].Note(world_.mechanism(body), speed);
    momentum_[own] += world_.mass(body) * speed;
    mass_[own] += world_.mass(body);
  }
  AddMovers(boxes);
}

/// A mover joins no islands: it may be as large as the scene. Each counts as an own mechanism, with
/// its greatest speed of that time.
void Strikers::AddMovers(const std::vector<MovingBox>& boxes) {
  const Composition& c = world_.composition();
  if (!movers_) movers_.emplace(world_.scene(), c);
  const double reach = kSeconds / world_.dt();
  for (int m = 0; m < movers_->count(); ++m) {
    const float extent =
        ExtentOf(world_, c.assemblies[static_cast<std::size_t>(movers_->assembly(m))]);
    float speed = 0;
    Eigen::AlignedBox2f swept;
    for (int i = -kMoverLooks; i <= kMoverLooks; ++i) {
      const double tick = static_cast<double>(world_.tick()) + reach * i / kMoverLooks;
      const BodyState at = movers_->At(m, tick);
      speed = std::max(speed, at.velocity.norm() + extent * std::fabs(at.spin));
      swept.extend(at.position);
    }
    // Between two looks it goes farther than both.
    const float margin = extent + speed * kSeconds / kMoverLooks;
    swept.min() -= Vec2::Constant(margin);
    swept.max() += Vec2::Constant(margin);
    for (const MovingBox& box : boxes) {
      if (!swept.intersects(Eigen::AlignedBox2f(box.min, box.max))) continue;
      fastest_[static_cast<std::size_t>(island_[static_cast<std::size_t>(box.group)])].Note(
          static_cast<int>(c.mechanisms.size()) + m, speed);
    }
  }
}

void Strikers::Fastest::Note(int its, float its_speed) {
  if (its == mechanism) {
    speed = std::max(speed, its_speed);
  } else if (its_speed > speed) {
    of_others = std::exchange(speed, its_speed);
    mechanism = its;
  } else {
    of_others = std::max(of_others, its_speed);
  }
}

float Strikers::AddedSpeed(int body) {
  Look();
  const int mechanism = world_.mechanism(body);
  const auto island = static_cast<std::size_t>(island_[static_cast<std::size_t>(mechanism)]);
  const Fastest& fastest = fastest_[island];
  return kMostThrown * (fastest.mechanism == mechanism ? fastest.of_others : fastest.speed);
}

/// All that moves may load a joint of anchored parts.
float Strikers::LoadOf(const Joint& joint) {
  Look();
  float momentum = 0, mass = 0;
  const int a = seam::MechanismOf(world_, joint.a), b = seam::MechanismOf(world_, joint.b);
  const bool anchored = a < 0 && b < 0;
  for (std::size_t m = 0; m < island_.size(); ++m) {
    const auto is = [&](int own) {
      return own >= 0 && island_[static_cast<std::size_t>(own)] == static_cast<int>(m);
    };
    if (!anchored && !is(a) && !is(b)) continue;
    momentum += momentum_[m];
    mass += mass_[m];
  }
  const float substep = world_.dt() / static_cast<float>(world_.scene().solver.substeps);
  return kMostThrown * (momentum / substep + mass * world_.scene().gravity.norm());
}

}  // namespace seam
