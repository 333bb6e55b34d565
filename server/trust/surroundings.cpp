#include "server/trust/surroundings.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <utility>

#include "common/scene/mechanism_ids.h"
#include "common/sync/quantize.h"
#include "common/sync/reach/zones.h"
#include "server/rules/impact_check.h"

namespace seam {
namespace {

/// No client is thought to be later than this, s: what it does with others' bodies is not audited
/// meanwhile.
constexpr float kLagMostS = 1;

/// Old looks are dropped at each of so many: reaches are larger until then, which no result shows.
constexpr std::int64_t kLooksToDrop = 5;

/// Side of a cell, and the greatest extent and way within kLagMostS of bodies that are only looked
/// at in the cells of others, m.
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

/// Where bodies of this place and velocity may be within `seconds`.
Eigen::AlignedBox2f Swept(const Eigen::AlignedBox2f& place, const Eigen::AlignedBox2f& velocity,
                          float seconds) {
  Eigen::AlignedBox2f swept = place;
  swept.min() += velocity.min().cwiseMin(0) * seconds;
  swept.max() += velocity.max().cwiseMax(0) * seconds;
  return swept;
}

}  // namespace

Surroundings::Surroundings(const Replica& replica)
    : replica_(replica),
      heard_(static_cast<std::size_t>(kPeersMax), -1),
      lag_(heard_.size(), 0),
      forget_(replica.table(), [this](const BodyRemap&) { Forget(); }) {
  Forget();
}

void Surroundings::Forget() {
  const World& world = replica_.world();
  const Composition& c = world.composition();
  first_ = newest_ = -1;
  trails_.assign(c.mechanisms.size(), Trail());
  reach_.assign(c.mechanisms.size(), Box());
  seen_.clear();
  large_.assign(static_cast<std::size_t>(world.body_count()), 0);
  for (int body = 0; body < world.body_count(); ++body) {
    const int assembly = c.assembly_of_part[static_cast<std::size_t>(world.id(body))];
    const float extent = ExtentOf(world, c.assemblies[static_cast<std::size_t>(assembly)]);
    large_[static_cast<std::size_t>(body)] = extent > kSmall ? 1 : 0;
  }
}

std::int64_t Surroundings::LagMost() const {
  const int tick_hz = replica_.world().scene().solver.tick_hz;
  return static_cast<std::int64_t>(kLagMostS * static_cast<float>(tick_hz));
}

void Surroundings::Note(std::array<Look, kLooks> Trail::*looks, std::int64_t tick, int body,
                        const BodyState& state) {
  const World& world = replica_.world();
  const auto mechanism = static_cast<std::size_t>(world.mechanism(body));
  Trail& trail = trails_[mechanism];
  const std::int64_t number = tick / kEvery;
  Look& look = (trail.*looks)[static_cast<std::size_t>(number) % kLooks];
  if (look.number > number) return;
  if (look.number < number) look = Look{number, Box(), Box()};
  const auto [min, max] = world.Bounds(body);
  const Vec2 off = state.position - world.Read(body).position;
  const Box place(Vec2(min + off), Vec2(max + off));
  look.place.extend(place);
  look.velocity.extend(state.velocity);
  trail.newest = std::max(trail.newest, number);
  Widen(mechanism, Swept(place, Box(state.velocity), kLagMostS));
}

void Surroundings::Widen(std::size_t mechanism, const Box& places) {
  if (reach_[mechanism].isEmpty()) seen_.push_back(static_cast<int>(mechanism));
  reach_[mechanism].extend(places);
}

void Surroundings::NoteTold(const States& states) {
  const World& world = replica_.world();
  std::int64_t& heard = heard_[static_cast<std::size_t>(states.peer)];
  std::int64_t& lag = lag_[static_cast<std::size_t>(states.peer)];
  lag = std::clamp(world.tick() - heard, lag, std::max(lag, LagMost()));
  heard = std::max(heard, states.tick);
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world.BodyOfId(states.id[i]);
    if (body < 0) continue;
    Note(&Trail::told, states.tick, body, Unpack(states, i, world.Read(body).angle));
  }
}

void Surroundings::DropOldLooks() {
  const std::int64_t oldest = replica_.world().tick() / kEvery - static_cast<std::int64_t>(kLooks);
  for (const int seen : std::exchange(seen_, {})) {
    const auto m = static_cast<std::size_t>(seen);
    Trail& trail = trails_[m];
    reach_[m].setEmpty();
    if (trail.newest <= oldest) trail = Trail();
    if (trail.newest < 0) continue;
    for (auto* const looks : {&trail.told, &trail.had}) {
      for (Look& look : *looks) {
        if (look.number <= oldest) look = Look();
        if (look.number >= 0) Widen(m, Swept(look.place, look.velocity, kLagMostS));
      }
    }
  }
}

void Surroundings::AfterTick(const std::vector<int>& mechanisms) {
  const World& world = replica_.world();
  if (world.tick() % kEvery != 0) return;
  // A lag that was worse a while ago counts less and less.
  for (std::int64_t& lag : lag_) lag = std::max<std::int64_t>(0, lag - 1);
  if (world.tick() % (kEvery * kLooksToDrop) == 0) DropOldLooks();
  Cells cells;
  for (const int m : mechanisms) {
    EachIdOf(world.composition(), m, [&](PartId id) {
      const int body = world.BodyOfId(id);
      const auto [min, max] = world.Bounds(body);
      const float way = world.Read(body).velocity.norm() * kLagMostS;
      const float reach = way + 2 * kSmall + kZoneSlack;
      cells.Add(min - Vec2(reach, reach), max + Vec2(reach, reach));
    });
  }
  for (int body = 0; !mechanisms.empty() && body < world.body_count(); ++body) {
    const BodyState state = world.Read(body);
    const bool fast = state.velocity.squaredNorm() * kLagMostS * kLagMostS > kSmall * kSmall;
    const bool large = large_[static_cast<std::size_t>(body)] != 0;
    if (!fast && !large && !cells.Has(state.position)) continue;
    Note(&Trail::had, world.tick(), body, state);
  }
  newest_ = world.tick();
  if (first_ < 0) first_ = newest_;
  first_ = std::max(first_, newest_ - static_cast<std::int64_t>(kLooks - 1) * kEvery);
}

/// Where it was told to be, or if nothing was told where the server had it.
Surroundings::Box Surroundings::PlacesOf(int mechanism, std::int64_t from, std::int64_t to) const {
  const Trail& trail = trails_[static_cast<std::size_t>(mechanism)];
  Box places;
  for (const auto* const looks : {&trail.told, &trail.had}) {
    for (const Look& look : *looks) {
      if (look.number >= from / kEvery && look.number <= to / kEvery) places.extend(look.place);
    }
    if (!places.isEmpty()) break;
  }
  return places;
}

/// How late the server hears of a mechanism, ticks.
std::int64_t Surroundings::LagOf(int mechanism) const {
  return lag_[static_cast<std::size_t>(replica_.authority().at(mechanism).authority)];
}

bool Surroundings::MayTouch(const Box& own, int mechanism, int other, std::int64_t from,
                            std::int64_t to) const {
  const Vec2 slack(kZoneSlack, kZoneSlack);
  const Box wide(Vec2(own.min() - slack), Vec2(own.max() + slack));
  if (!reach_[static_cast<std::size_t>(other)].intersects(wide)) return false;
  const Trail& trail = trails_[static_cast<std::size_t>(other)];
  const std::int64_t lag =
      std::max(kEvery, std::min(LagMost(), LagOf(mechanism) + LagOf(other) + kEvery));
  const float dt = replica_.world().dt();
  for (const auto* const looks : {&trail.told, &trail.had}) {
    for (const Look& look : *looks) {
      const std::int64_t tick = look.number * kEvery;
      if (tick + kEvery <= from - lag || tick > to + kEvery) continue;
      const float seconds =
          static_cast<float>(std::clamp<std::int64_t>(to - tick, kEvery, lag)) * dt;
      if (Swept(look.place, look.velocity, seconds).intersects(wide)) return true;
    }
  }
  return false;
}

}  // namespace seam
