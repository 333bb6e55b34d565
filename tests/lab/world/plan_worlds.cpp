#include "tests/lab/world/plan_worlds.h"

#include <algorithm>

#include "common/base/random.h"

namespace seam {
namespace {

class Maker {
 public:
  Maker(const PlanWorld& world, std::uint64_t seed) : world_(world), random_(seed) {}

  AuthorityView Make() {
    view_.buffer_m = 6;
    view_.follow_bodies = world_.follow_bodies;
    view_.server_follow = world_.server_follow;
    view_.islands = !world_.regions;
    for (int p = 0; p < world_.players; ++p) AddPlayer(p);
    for (int m = 0; m < world_.mechanisms; ++m) AddMechanism(m);
    return std::move(view_);
  }

 private:
  float Between(float low, float high) {
    return low + (high - low) * static_cast<float>(random_.Uniform());
  }
  bool Chance(double share) { return random_.Uniform() < share; }

  void AddPlayer(int p) {
    PlayerView player;
    player.peer = Chance(0.1) ? -1 : p + 1;
    player.one_way_s = Between(0, world_.one_way_s);
    player.silent = Chance(0.1);
    const float each = world_.width / static_cast<float>(world_.players);
    const float left = -world_.width / 2 + each * static_cast<float>(p);
    if (world_.regions) {
      player.has_region = true;
      player.region_min = {left, -world_.height};
      player.region_max = {left + each, world_.height};
    }
    view_.players.push_back(player);
    const Vec2 at = Somewhere();
    const Vec2 velocity(Between(-15, 15), 0);
    AddBox(at, {1.5f, 0.5f}, velocity, kDrivenAcceleration);
    AddBox(at + Vec2(-1, -0.5f), {0.4f, 0.4f}, velocity, kDrivenAcceleration);
    AddBox(at + Vec2(1, -0.5f), {0.4f, 0.4f}, velocity, kDrivenAcceleration);
    Finish(at, p);
  }

  void AddMechanism(int m) {
    const Vec2 at = Somewhere();
    const float most = Chance(world_.fast) ? 10 * world_.speed : Chance(0.5) ? world_.speed : 0;
    const Vec2 velocity(Between(-most, most), Between(-most, most) / 2);
    const int links = world_.chains && m % 25 == 7 ? 12 : 1;
    for (int link = 0; link < links; ++link) {
      const Vec2 half(Between(0.2f, 0.8f), Between(0.2f, 0.8f));
      AddBox(at + Vec2(1.6f * static_cast<float>(link), 0),
             world_.chains && m % 60 == 9 ? Vec2(10, 1) : half, velocity, 0);
    }
    Finish(at, -1);
  }

  Vec2 Somewhere() {
    return {Between(-world_.width / 2, world_.width / 2),
            Between(-world_.height / 2, world_.height / 2)};
  }

  void AddBox(const Vec2& at, const Vec2& half, const Vec2& velocity, float acceleration) {
    MovingBox box;
    box.min = at - half;
    box.max = at + half;
    box.velocity = velocity;
    box.acceleration = acceleration;
    box.group = static_cast<int>(view_.mechanisms.size());
    view_.boxes.push_back(box);
  }

  void Finish(const Vec2& at, int owner) {
    MechanismView mechanism;
    mechanism.position = at;
    mechanism.owner = mechanism.driver = owner;
    mechanism.held_ticks = Chance(0.2) ? 10 : 1000;
    mechanism.moves = Chance(0.7);
    mechanism.asleep = !mechanism.moves && Chance(0.5);
    if (Chance(0.1)) {
      mechanism.may_have = {};
      for (int p = 0; p < world_.players; p += 2) mechanism.may_have.Add(p);
    }
    mechanism.now.authority = Chance(0.3) ? 0 : Player();
    for (int n = Chance(0.5) ? 0 : 3; n > 0; --n) mechanism.now.secondaries.Add(Player());
    view_.mechanisms.push_back(mechanism);
  }

  /// A peer.
  int Player() {
    return 1 + std::min(world_.players - 1, static_cast<int>(random_.Uniform() * world_.players));
  }

  const PlanWorld& world_;
  Random random_;
  AuthorityView view_;
};

}  // namespace

AuthorityView RandomView(const PlanWorld& world, std::uint64_t seed) {
  return Maker(world, seed).Make();
}

}  // namespace seam
