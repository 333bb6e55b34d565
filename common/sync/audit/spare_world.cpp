#include "common/sync/audit/spare_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/scene/character.h"

namespace seam {
namespace {

/// The limbs of a character, left and right.
constexpr std::array<std::pair<CharacterPart, CharacterPart>, 5> kLimbSides = {
    {{kUpperArmLeft, kUpperArmRight},
     {kLowerArmLeft, kLowerArmRight},
     {kUpperLegLeft, kUpperLegRight},
     {kLowerLegLeft, kLowerLegRight},
     {kFootLeft, kFootRight}}};

/// Position of a body's centre of mass, m.
Vec2 CentreOf(const World& world, int body, const BodyState& state) {
  const Transform2 frame{state.position.cast<double>(), double{state.angle}};
  return frame(world.mass_point(body).centre.cast<double>()).cast<float>();
}

/// Sums of a mechanism's bodies.
struct Whole {
  Vec2 position{0, 0}, velocity{0, 0};
  float mass = 0;
  void Add(const Vec2& centre, const BodyState& state, float body_mass) {
    position += body_mass * centre;
    velocity += body_mass * state.velocity;
    mass += body_mass;
  }
};

}  // namespace

SpareWorld::SpareWorld(const Topology& topology, Present present) : world_(topology) {
  Number();
  if (present == Present::kAll) return;
  for (int body = 0; body < world_.body_count(); ++body) {
    world_.SetActivity(body, Activity::kParked);
  }
}

void SpareWorld::Number() {
  const auto count = static_cast<std::size_t>(world_.body_count());
  const std::size_t mechanisms = world_.composition().mechanisms.size();
  turns_.emplace(world_);
  bodies_.assign(mechanisms, {});
  standings_.assign(mechanisms, {});
  for (int body = 0; body < world_.body_count(); ++body) {
    bodies_[static_cast<std::size_t>(world_.mechanism(body))].push_back(body);
  }
  other_side_.resize(count);
  std::iota(other_side_.begin(), other_side_.end(), 0);
  character_of_.assign(mechanisms, -1);
  const auto& characters = world_.scene().characters;
  exchanged_.resize(characters.size(), 0);
  before_.resize(characters.size());
  for (std::size_t c = 0; c < characters.size(); ++c) {
    const int m = MechanismOf(world_, characters[c].parts[kTorso]);
    if (m < 0 || character_of_[static_cast<std::size_t>(m)] >= 0) continue;
    character_of_[static_cast<std::size_t>(m)] = static_cast<int>(c);
    for (const auto& [left, right] : kLimbSides) {
      const int a = world_.BodyOfId(characters[c].parts[static_cast<std::size_t>(left)]);
      const int b = world_.BodyOfId(characters[c].parts[static_cast<std::size_t>(right)]);
      if (a < 0 || b < 0 || world_.mechanism(a) != m || world_.mechanism(b) != m) continue;
      std::swap(other_side_[static_cast<std::size_t>(a)], other_side_[static_cast<std::size_t>(b)]);
    }
  }
}

void SpareWorld::Apply(const Edit& edit) {
  if (!world_.Apply({edit})) return;
  Number();
  for (int body = 0; body < world_.body_count(); ++body) {
    world_.SetActivity(body, Activity::kParked);
  }
}

std::vector<float> SpareWorld::MemoryOf(int character) {
  const std::vector<float> all = world_.Keep().stages;
  const CharacterNumbers own = NumbersOf(world_.scene(), character, all.size());
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(own.first);
  return {first, first + static_cast<std::ptrdiff_t>(own.count)};
}

void SpareWorld::Remember(int character, const std::vector<float>& memory) {
  WorldSnapshot now = world_.Keep();
  const CharacterNumbers own = NumbersOf(world_.scene(), character, now.stages.size());
  SEAM_ASSERT(own.count == memory.size());
  std::copy(memory.begin(), memory.end(),
            now.stages.begin() + static_cast<std::ptrdiff_t>(own.first));
  SEAM_ASSERT(world_.Restore(now).ok());
}

bool SpareWorld::TryOther(int mechanism, int other) {
  const int character = character_of_[static_cast<std::size_t>(mechanism)];
  if (character < 0) return false;
  Before& before = before_[static_cast<std::size_t>(character)];
  char& exchanged = exchanged_[static_cast<std::size_t>(character)];
  if (other == 0) {
    before.tick = world_.tick();
    before.memory = MemoryOf(character);
    before.exchanged = exchanged;
    before.others = OtherStates(before.memory);
  }
  const float later = static_cast<float>(world_.tick() - before.tick) * world_.dt();
  exchanged = before.exchanged;
  if (before.memory.empty()) return false;
  Remember(character, LaterInMode(before.memory, later));
  if (static_cast<std::size_t>(other) >= before.others.size()) return false;
  const CharacterGuess& guess = before.others[static_cast<std::size_t>(other)];
  if (guess.sides) {
    exchanged = exchanged == 0 ? 1 : 0;
  } else {
    Remember(character, guess.memory);
  }
  return true;
}

int SpareWorld::PlaceOf(int mechanism, int body) const {
  const int character = character_of_[static_cast<std::size_t>(mechanism)];
  const bool stays = character < 0 || exchanged_[static_cast<std::size_t>(character)] == 0;
  return stays ? body : other_side_[static_cast<std::size_t>(body)];
}

void SpareWorld::Put(int mechanism, int holder, std::vector<BodyState> states) {
  const std::vector<int>& own = bodies(mechanism);
  turns_->Right(own, &states);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const int body = PlaceOf(mechanism, own[i]);
    world_.SetActivity(body, Activity::kSimulated);
    world_.Write(body, states[i]);
  }
  standings_[static_cast<std::size_t>(mechanism)] = {holder, false, false, world_.tick()};
}

void SpareWorld::Take(int mechanism) {
  for (const int body : bodies(mechanism)) world_.SetActivity(body, Activity::kParked);
  standings_[static_cast<std::size_t>(mechanism)] = {};
}

void SpareWorld::Step(const std::function<void(World*)>& inputs) {
  inputs(&world_);
  world_.Step();
  for (const Touch& touch : world_.touches()) {
    Standing& a = standings_[static_cast<std::size_t>(world_.mechanism(touch.body_a))];
    Standing& b = standings_[static_cast<std::size_t>(world_.mechanism(touch.body_b))];
    if (&a == &b) continue;
    a.met = b.met = true;
    if (a.holder != b.holder || a.lost != b.lost) a.lost = b.lost = true;
  }
}

std::optional<Gain> SpareWorld::Compare(int mechanism, const ToldNow& told) const {
  const Standing& standing = standings_[static_cast<std::size_t>(mechanism)];
  if (standing.holder <= 0 || standing.lost) return std::nullopt;
  const std::vector<int>& own = bodies(mechanism);
  Whole is, would_be;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!told[i]) continue;
    const float mass = world_.mass(own[i]);
    const BodyState stepped = world_.Read(PlaceOf(mechanism, own[i]));
    is.Add(CentreOf(world_, own[i], *told[i]), *told[i], mass);
    would_be.Add(CentreOf(world_, own[i], stepped), stepped, mass);
  }
  if (is.mass <= 0) return std::nullopt;
  Gain gain;
  gain.met = standing.met;
  gain.seconds = static_cast<double>(world_.tick() - standing.put) * double{world_.dt()};
  gain.position = (is.position - would_be.position) / is.mass;
  gain.velocity = (is.velocity - would_be.velocity) / is.mass;
  gain.stepped = would_be.velocity / is.mass;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!told[i]) continue;
    const BodyState stepped = world_.Read(PlaceOf(mechanism, own[i]));
    const Vec2 moved = CentreOf(world_, own[i], *told[i]) - CentreOf(world_, own[i], stepped);
    gain.apart = std::max(gain.apart, double{(moved - gain.position).norm()});
  }
  return gain;
}

}  // namespace seam
