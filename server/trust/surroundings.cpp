#include "server/trust/surroundings.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <tuple>

#include "common/scene/mechanism_ids.h"
#include "common/sync/reach/zones.h"
#include "server/rules/impact_check.h"

namespace seam {
namespace {

/// Looks that are kept: two seconds.
constexpr std::size_t kLooks = 20;
/// Mechanisms that may touch within this time are near, s: a client that shows another's bodies
/// late strikes them where the server does not have them.
constexpr float kNearS = 0.25f;

/// Side of a cell, and the greatest extent and way within kNearS of bodies that are only looked at
/// in the cells of others, m.
constexpr float kLookCell = 16, kSmall = 8;

/// Cells with something to look at. Cells may share a place here: then more is looked at.
class Cells {
 public:
  void Add(const Vec2& min, const Vec2& max) {
    const std::int64_t bottom = Index(min.y()), top = Index(max.y());
    for (std::int64_t x = Index(min.x()); x <= Index(max.x()); ++x) {
      for (std::int64_t y = bottom; y <= top; ++y) cells_.set(Place(x, y));
    }
  }
  bool Has(const Vec2& at) const { return cells_.test(Place(Index(at.x()), Index(at.y()))); }

 private:
  static constexpr std::size_t kPlaces = 1 << 16;
  static std::int64_t Index(float at) {
    return static_cast<std::int64_t>(std::floor(at / kLookCell));
  }
  static std::size_t Place(std::int64_t x, std::int64_t y) {
    const auto key = static_cast<std::uint64_t>(x * 73856093 + y * 19349663);
    return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 48);
  }
  std::bitset<kPlaces> cells_;
};

}  // namespace

Surroundings::Surroundings(const Replica& replica)
    : replica_(replica), forget_(replica.table(), [this](const BodyRemap&) {
        looks_.clear();
        FindLarge();
      }) {
  FindLarge();
}

void Surroundings::FindLarge() {
  const World& world = replica_.world();
  const Composition& c = world.composition();
  large_.assign(static_cast<std::size_t>(world.body_count()), 0);
  for (int body = 0; body < world.body_count(); ++body) {
    const int assembly = c.assembly_of_part[static_cast<std::size_t>(world.id(body))];
    const float extent = ExtentOf(world, c.assemblies[static_cast<std::size_t>(assembly)]);
    large_[static_cast<std::size_t>(body)] = extent > kSmall ? 1 : 0;
  }
}

void Surroundings::AfterTick(const std::vector<int>& mechanisms) {
  const World& world = replica_.world();
  if (world.tick() % kEvery != 0) return;
  Cells cells;
  for (const int m : mechanisms) {
    EachIdOf(world.composition(), m, [&](PartId id) {
      const int body = world.BodyOfId(id);
      const auto [min, max] = world.Bounds(body);
      const float reach = world.Read(body).velocity.norm() * kNearS + 2 * kSmall + kZoneSlack;
      cells.Add(min - Vec2(reach, reach), max + Vec2(reach, reach));
    });
  }
  std::vector<MovingBox> boxes;
  for (int body = 0; !mechanisms.empty() && body < world.body_count(); ++body) {
    const BodyState state = world.Read(body);
    const bool fast = state.velocity.norm() * kNearS > kSmall;
    const bool large = large_[static_cast<std::size_t>(body)] != 0;
    if (!fast && !large && !cells.Has(state.position)) continue;
    MovingBox box;
    std::tie(box.min, box.max) = world.Bounds(body);
    if (world.awake(body)) box.velocity = state.velocity;
    box.group = world.mechanism(body);
    boxes.push_back(box);
  }
  Look look;
  look.tick = world.tick();
  look.near = MeetingGroups(boxes, kNearS);
  const std::size_t once = look.near.size();
  for (std::size_t i = 0; i < once; ++i) {
    look.near.emplace_back(look.near[i].second, look.near[i].first);
  }
  std::sort(look.near.begin(), look.near.end());
  looks_.push_back(std::move(look));
  if (looks_.size() > kLooks) looks_.pop_front();
}

}  // namespace seam
