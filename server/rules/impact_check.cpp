#include "server/rules/impact_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/geometry.h"
#include "common/codec/quanta.h"
#include "common/scene/mass.h"
#include "common/sync/reach/zones.h"

namespace seam {
namespace {

/// Allowed change of velocity beyond the momentum's, m/s: for rounding and the impulse of motors in
/// one tick.
constexpr float kSlack = 1.0f;
/// Largest distance of the point from the bodies, m, besides their motion in kTicksAround.
constexpr float kNear = 0.5f;

const Assembly& AssemblyOf(const World& world, int body) {
  const Composition& c = world.composition();
  const int index = c.assembly_of_part[static_cast<std::size_t>(world.id(body))];
  return c.assemblies[static_cast<std::size_t>(index)];
}

/// Returns the distance from a part's position to its farthest point, m.
float ExtentOf(const Part& part) {
  float own = std::max(part.radius, part.kind == ShapeKind::kBox ? part.size.norm() / 2 : 0.0f);
  for (const Vec2& point : part.points) own = std::max(own, point.norm() + part.radius);
  return own;
}

float ExtentOf(const World& world, int body) { return ExtentOf(world, AssemblyOf(world, body)); }

/// Extends a box by the body's parts in a pose, each as a disc around it.
void Extend(const World& world, int body, const BodyState& at, MovingBox* box) {
  const std::vector<Part>& parts = world.scene().parts;
  const Part& root = parts[static_cast<std::size_t>(world.id(body))];
  for (const PartId id : AssemblyOf(world, body).parts) {
    const Part& part = parts[static_cast<std::size_t>(id)];
    const Vec2 local = ToRootFrame(part, root, Eigen::Vector2d(0, 0)).cast<float>();
    const Vec2 place = at.position + Turned(local, at.angle);
    const Vec2 reach = Vec2::Constant(ExtentOf(part));
    box->min = box->min.cwiseMin(place - reach);
    box->max = box->max.cwiseMax(place + reach);
  }
}

float LargestRestitution(const World& world, const std::vector<int>& bodies) {
  float largest = 0;
  for (const int body : bodies) {
    for (const PartId id : AssemblyOf(world, body).parts) {
      const Part& part = world.scene().parts[static_cast<std::size_t>(id)];
      largest = std::max(largest, part.material.restitution);
    }
  }
  return largest;
}

/// Returns the largest distance between two velocities of the lists, m/s.
float LargestApart(const std::vector<Vec2>& one, const std::vector<Vec2>& other) {
  float largest = 0;
  for (const Vec2& a : one) {
    for (const Vec2& b : other) largest = std::max(largest, (a - b).norm());
  }
  return largest;
}

}  // namespace

float ExtentOf(const World& world, const Assembly& assembly) {
  const std::vector<Part>& parts = world.scene().parts;
  const Part& root = parts[static_cast<std::size_t>(assembly.id)];
  float reach = 0;
  for (const PartId id : assembly.parts) {
    const Part& part = parts[static_cast<std::size_t>(id)];
    reach = std::max(reach, (part.position - root.position).norm() + ExtentOf(part));
  }
  return reach;
}

/// A velocity that was told counts only as far as the places before or after it confirm it: the
/// mean velocity between two places, and what weight, throttle and brakes change in that time. So
/// one more state before those around the tick is looked at: the next may be lost.
ImpactCheck::Moved ImpactCheck::MotionOf(int body) const {
  Moved moved;
  const Trail seen = trail_.Around(body, tick_ - 2 * kTicksAround, tick_ + kTicksAround);
  moved.known = !seen.empty() && seen.front().tick <= tick_ + kTicksAround;
  std::size_t first = 0;  // of the states around the tick
  while (first + 1 < seen.size() && seen[first + 1].tick <= tick_ - kTicksAround) ++first;
  const float force = world_.scene().gravity.norm() + kDrivenAcceleration;
  std::vector<bool> confirmed(seen.size(), false);
  for (std::size_t i = 1; i < seen.size(); ++i) {
    const BodyState &from = seen[i - 1].state, &to = seen[i].state;
    const float ticks = static_cast<float>(seen[i].tick - seen[i - 1].tick);
    const Vec2 way = to.position - from.position;
    if (way.norm() > StateTrail::kMaxStep * ticks) continue;  // it was moved, and did not move
    const float seconds = ticks * world_.dt();
    const Vec2 mean = way / seconds;
    if (i > first) moved.velocities.push_back(mean);
    const float reach = force * seconds + 2 * kPositionQuantum / seconds;
    for (const std::size_t told : {i - 1, i}) {
      const Vec2& velocity = seen[told].state.velocity;
      confirmed[told] = confirmed[told] || (velocity - mean).norm() <= reach;
    }
    if (i <= first) continue;
    // Angles say nothing of whole turns: where it may have made half of one, its word counts.
    const float told = std::max(std::fabs(from.spin), std::fabs(to.spin));
    const float turned = std::fabs(WrapAngle(to.angle - from.angle)) / seconds;
    const bool may_wrap = told * seconds > static_cast<float>(kPi);
    moved.spin = std::max(moved.spin, may_wrap ? told : std::min(told, turned));
  }
  for (std::size_t i = first; i < seen.size(); ++i) {
    if (confirmed[i]) moved.velocities.push_back(seen[i].state.velocity);
  }
  if (moved.velocities.empty()) moved.velocities.push_back(Vec2(0, 0));
  return moved;
}

/// True if the body was at the point around that tick, or its newest known state moves it there:
/// where inputs come late, states arrive later than impacts.
bool ImpactCheck::IsNear(int body, const Vec2& point) const {
  const float reach = ExtentOf(world_, body), dt = world_.dt();
  const Trail seen = trail_.Around(body, tick_ - kTicksAround, tick_ + kTicksAround);
  return std::any_of(seen.begin(), seen.end(), [&](const StateTrail::Seen& s) {
    const float moves = s.state.velocity.norm() * dt * static_cast<float>(kTicksAround);
    const Vec2 way = static_cast<float>(tick_ - s.tick) * dt * s.state.velocity;
    const Vec2 apart = point - s.state.position;
    return std::min(apart.norm(), (apart - way).norm()) <= reach + moves + kNear;
  });
}

std::vector<int> ImpactCheck::IslandOf(int body) {
  if (island_.empty()) {
    std::vector<MovingBox> boxes;
    for (int b = 0; b < world_.body_count(); ++b) {
      const Trail seen = trail_.Around(b, tick_, tick_);
      if (seen.empty()) continue;
      MovingBox box;
      box.min = box.max = seen.front().state.position;
      box.group = world_.mechanism(b);
      for (StateTrail::Seen s : seen) {
        if (s.tick > tick_ + kTicksAround) break;
        Extend(world_, b, s.state, &box);
        if (s.tick >= tick_) continue;
        s.state.position += static_cast<float>(tick_ - s.tick) * world_.dt() * s.state.velocity;
        Extend(world_, b, s.state, &box);
      }
      boxes.push_back(box);
    }
    island_ = Components(static_cast<int>(world_.composition().mechanisms.size()),
                         MeetingGroups(boxes, 0));
  }
  const int own = island_[static_cast<std::size_t>(world_.mechanism(body))];
  std::vector<int> bodies;
  for (int b = 0; b < world_.body_count(); ++b) {
    if (island_[static_cast<std::size_t>(world_.mechanism(b))] == own) bodies.push_back(b);
  }
  return bodies;
}

/// Takes the motion of around that tick: it may change from one tick to the next.
float ImpactCheck::FastestMover(const std::vector<int>& island, const std::vector<Vec2>& frame) {
  const Composition& composition = world_.composition();
  if (!movers_) movers_.emplace(world_.scene(), composition);
  if (movers_->count() == 0) return 0;
  std::vector<std::pair<Vec2, float>> discs;  // around each body: place and reach
  for (const int body : island) {
    const Trail seen = trail_.Around(body, tick_, tick_);
    if (seen.empty()) continue;
    const BodyState& at = seen.front().state;
    const float moves = at.velocity.norm() * world_.dt() * static_cast<float>(kTicksAround);
    discs.emplace_back(at.position, ExtentOf(world_, body) + kNear + moves);
  }
  float fastest = 0;
  for (int m = 0; m < movers_->count(); ++m) {
    const auto& assembly = composition.assemblies[static_cast<std::size_t>(movers_->assembly(m))];
    const float extent = ExtentOf(world_, assembly);
    for (const std::int64_t tick : {tick_ - 1, tick_, tick_ + 1}) {
      const BodyState at = movers_->At(m, static_cast<double>(tick));
      const bool meets = std::any_of(discs.begin(), discs.end(), [&](const auto& disc) {
        return (disc.first - at.position).norm() <= disc.second + extent;
      });
      if (!meets) continue;
      const float turning = std::fabs(at.spin) * extent;
      fastest = std::max(fastest, LargestApart({at.velocity}, frame) + turning);
    }
  }
  return fastest;
}

bool ImpactCheck::Explained(const Blow& blow) {
  const bool anchored = blow.by < 0;
  // The frame of the impact: the struck body, or what is anchored.
  std::vector<Vec2> frame = {Vec2(0, 0)};
  if (!anchored) frame = MotionOf(blow.body).velocities;
  std::vector<int> island = IslandOf(blow.body);
  if (!anchored && std::find(island.begin(), island.end(), blow.by) == island.end()) {
    const std::vector<int> more = IslandOf(blow.by);
    island.insert(island.end(), more.begin(), more.end());
  }
  float momentum = 0, mass = 0, fastest = 0;
  for (const int body : island) {
    const Moved moved = MotionOf(body);
    const float turning = moved.spin * ExtentOf(world_, body);
    const float speed = LargestApart(moved.velocities, frame) + turning;
    momentum += world_.mass(body) * speed;
    mass += world_.mass(body);
    fastest = std::max(fastest, speed);
  }
  // What moves along a path has any momentum.
  const float mover = FastestMover(island, frame);
  momentum += mass * mover;
  fastest = std::max(fastest, mover);
  // The restitution of anchored parts is not looked up.
  const float e = anchored || mover > 0 ? 1 : LargestRestitution(world_, island);
  if (blow.dv <= (1 + e) * fastest + kSlack) return true;
  if (!IsHeld(blow, island)) return false;
  const float weight = mass * world_.scene().gravity.norm() * world_.dt();
  return blow.dv <= ((1 + e) * momentum + weight) / world_.mass(blow.body) + kSlack;
}

bool ImpactCheck::IsHeld(const Blow& blow, const std::vector<int>& island) const {
  const int own = world_.mechanism(blow.body);
  const int by = blow.by < 0 ? own : world_.mechanism(blow.by);
  const bool others = std::any_of(island.begin(), island.end(), [&](int body) {
    const int m = world_.mechanism(body);
    return body != blow.body && (m == own || m != by);
  });
  if (others) return true;
  const Trail seen = trail_.Around(blow.body, tick_, tick_);
  const Vec2 at = seen.front().state.position;
  const float reach = ExtentOf(world_, blow.body) + kNear;
  std::vector<Vec2> ways = {at - blow.point}, velocities = {Vec2(0, 0)};
  if (blow.by >= 0) velocities = MotionOf(blow.by).velocities;
  for (const Vec2& own_velocity : MotionOf(blow.body).velocities) {
    for (const Vec2& velocity : velocities) ways.push_back(velocity - own_velocity);
  }
  return std::any_of(ways.begin(), ways.end(), [&](const Vec2& way) {
    return way.norm() > 0 && world_.FreeWay(blow.body, at, at + reach * way.normalized()) < 1;
  });
}

bool ImpactCheck::MoreMayCome(const Blow& blow) const {
  const auto more = [this](int body) {
    const StateTrail::Seen* const newest = trail_.Newest(body);
    return newest == nullptr || newest->tick < tick_ + kTicksAround;
  };
  return more(blow.body) || (blow.by >= 0 && more(blow.by));
}

bool ImpactCheck::Possible(const Blow& blow) {
  for (const int body : {blow.body, blow.by}) {
    if (body >= 0 && !(MotionOf(body).known && IsNear(body, blow.point))) return false;
  }
  return Explained(blow);
}

}  // namespace seam
