/// Leaving a seat: the player is drawn out as one rigid body, upwards from the seat, until clear of
/// the vehicle; until then the two do not collide. The vehicle receives the reaction.

#include <cmath>

#include "common/physics/world.h"
#include "common/stages/make_stages.h"
#include "common/stages/seat_pull.h"

namespace seam {
namespace {

/// Fewest ticks before release: contacts are only found in the steps.
constexpr int kLeaveTicksMin = 3;

/// A player on the way out. All of it is saved.
struct Departure {
  int ticks = -1;    // since the bond broke; -1: none
  PartId part = -1;  // the part that was fastened to the seat
};

class SeatLeaveStage : public Stage {
 public:
  explicit SeatLeaveStage(const StageWorld& world)
      : w_(world), departures_(world.scene.seats.size()), touches_(world.scene.seats.size()) {}

  void Rebuilt(b2World* world) override { gravity_ = world->GetGravity(); }
  void Emptied() override { sides_.clear(); }

  void Edited(const Edit& edit) override {
    const BreakEdit* broken = edit.As<BreakEdit>();
    if (broken == nullptr || broken->joint < 0) return;
    const Joint& joint = w_.scene.joints[static_cast<std::size_t>(broken->joint)];
    if (joint.kind != JointKind::kGlue) return;
    for (std::size_t s = 0; s < departures_.size(); ++s) {
      const Seat& seat = w_.scene.seats[s];
      if (seat.player < 0 || joint.a != seat.part) continue;
      const PartId own = w_.scene.players[static_cast<std::size_t>(seat.player)].vehicle;
      if (joint.b == own) departures_[s] = {0, own};
    }
  }

  void BeforeTick() override {
    sides_.clear();
    touches_.assign(touches_.size(), false);
    for (std::size_t s = 0; s < departures_.size(); ++s) {
      if (departures_[s].ticks < 0) continue;
      if (!IsApart(s)) departures_[s] = Departure();
      if (departures_[s].ticks < 0) continue;
      sides_.resize(w_.built.moving.size(), 0);
      const int out = MechanismOf(departures_[s].part), in = MechanismOf(SeatOf(s).part);
      const int side = static_cast<int>(s) + 1;
      for (std::size_t i = 0; i < sides_.size(); ++i) {
        if (w_.built.moving[i].mechanism == out) sides_[i] = side;
        if (w_.built.moving[i].mechanism == in) sides_[i] = -side;
      }
    }
  }

  void BeforeStep(float h) override {
    for (std::size_t s = 0; s < departures_.size(); ++s) {
      if (departures_[s].ticks >= 0) PullOut(s, h);
    }
  }

  void AfterTick() override {
    const auto most = static_cast<int>(kLeaveSeconds * w_.scene.solver.tick_hz);
    for (std::size_t s = 0; s < departures_.size(); ++s) {
      Departure& d = departures_[s];
      if (d.ticks < 0) continue;
      ++d.ticks;
      const bool clear = d.ticks > kLeaveTicksMin && !touches_[s];
      if (clear || d.ticks > most) d = Departure();
    }
  }

  void Save(std::vector<float>* memory) const override {
    for (const Departure& d : departures_) {
      memory->push_back(static_cast<float>(d.ticks));
      memory->push_back(static_cast<float>(d.part));
    }
  }
  void Load(StageMemory* memory) override {
    const auto parts = static_cast<int>(w_.scene.parts.size());
    for (Departure& d : departures_) {
      d.ticks = memory->NextInt(-1, kStageNumberMax);
      d.part = memory->NextInt(-1, parts - 1);
      if (d.part < 0) d.ticks = -1;
    }
  }

  bool listens() const override { return true; }
  void PreSolve(b2Contact* contact) override {
    if (sides_.empty()) return;
    const int a = SideOf(contact->GetFixtureA()->GetBody());
    const int b = SideOf(contact->GetFixtureB()->GetBody());
    if (a == 0 || a != -b) return;
    touches_[static_cast<std::size_t>(std::abs(a) - 1)] = true;
    contact->SetEnabled(false);
  }

 private:
  const Seat& SeatOf(std::size_t seat) const { return w_.scene.seats[seat]; }
  int AssemblyOf(PartId part) const {
    return part < 0 ? -1 : w_.composition.assembly_of_part[static_cast<std::size_t>(part)];
  }
  const Assembly& At(int assembly) const {
    return w_.composition.assemblies[static_cast<std::size_t>(assembly)];
  }
  /// Requires an existing part.
  int MechanismOf(PartId part) const { return At(AssemblyOf(part)).mechanism; }
  int SideOf(b2Body* body) const {
    const int index = IndexOf(body);
    return index < 0 ? 0 : sides_[static_cast<std::size_t>(index)];
  }

  /// Returns true if the leaving part and the seat's part exist and are two separate mechanisms
  /// that move.
  bool IsApart(std::size_t seat) const {
    const int out = AssemblyOf(departures_[seat].part), in = AssemblyOf(SeatOf(seat).part);
    if (out < 0 || in < 0 || At(out).anchored || At(in).anchored) return false;
    return At(out).mechanism != At(in).mechanism;
  }

  void PullOut(std::size_t seat, float h) {
    const int out = MechanismOf(departures_[seat].part);
    const auto there = static_cast<std::size_t>(AssemblyOf(SeatOf(seat).part));
    b2Body* vehicle = w_.built.bodies[there];
    const b2Vec2 place = vehicle->GetPosition();
    const b2Vec2 upwards = kLeaveSpeed * vehicle->GetWorldVector(b2Vec2(0, 1));
    const auto velocity_of = [&](const b2Body* body) {
      return vehicle->GetLinearVelocityFromWorldPoint(body->GetWorldCenter()) + upwards;
    };
    const auto each = [&](const auto& visit) {
      for (std::size_t i = 0; i < w_.built.moving.size(); ++i) {
        const MovingBody& moving = w_.built.moving[i];
        if (moving.mechanism != out || w_.activities[i] != Activity::kSimulated) continue;
        visit(moving.body, moving.mass.mass);
      }
    };
    const b2Vec2 given =
        PullTogether(each, velocity_of, vehicle->GetAngularVelocity(), h, gravity_);
    if (vehicle->GetType() == b2_dynamicBody) vehicle->ApplyLinearImpulse(-given, place, true);
  }

  const StageWorld w_;
  std::vector<Departure> departures_;  // by the scene's seats
  std::vector<bool> touches_;          // by seat: the player touches the vehicle in this tick
  std::vector<int> sides_;  // by moving body: seat number from 1, -: the vehicle; empty: none
  b2Vec2 gravity_{0, 0};
};

}  // namespace

std::unique_ptr<Stage> MakeSeatLeaveStage(const StageWorld& world) {
  return std::make_unique<SeatLeaveStage>(world);
}

}  // namespace seam
