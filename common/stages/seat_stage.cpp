/// Seats: a player that takes a seat moves there with all limbs as one rigid body, without contacts
/// on the way; the bond follows on arrival. The motion starts after a delay, so that all peers have
/// received the edit by then. The change of its momentum on the way is compensated at the bond, so
/// that the vehicle receives the momentum that the player brought. A seated player's limbs do not
/// collide with the vehicle: most have no room for legs.
///
///   share of the way   1 |              ______  held until the bond
///                        |           .-'
///                      0 |________.-'
///                        taken     kSeatSeconds

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/world.h"
#include "common/stages/make_stages.h"
#include "common/stages/seat_pull.h"
#include "common/stages/seat_way.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// Longest wait for the bond, s; then the player is released.
constexpr int kHeldSecondsMax = 4;

/// In saved memory, the ticks of a late approach count downwards from here.
constexpr int kLateFrom = -2;

Transform2 PoseOf(const b2Body& body) {
  return {FromB2(body.GetPosition()).cast<double>(), static_cast<double>(body.GetAngle())};
}

/// A player on the way to a seat. All of it is saved.
struct Approach : SeatWay {
  bool late = false;  // this peer missed its start: progress is estimated from the bodies
  b2Vec2 came{0, 0};  // N s, of the whole mechanism, at the start
  b2Vec2 owed{0, 0};  // N s, lost on the way, to be repaid
};

class SeatStage : public Stage {
 public:
  explicit SeatStage(const StageWorld& world) : w_(world), approaches_(world.scene.seats.size()) {
    // A player may be on the way already when this peer joins the room.
    for (std::size_t s = 0; s < approaches_.size(); ++s) {
      if (!IsApart(s)) continue;
      approaches_[s].ticks = 0;
      approaches_[s].late = true;
    }
  }

  void Rebuilt(b2World* world) override {
    gravity_ = world->GetGravity();
    FindSides();
  }
  void Emptied() override {
    ghosts_.clear();
    sides_.clear();
  }

  /// A joining peer receives earlier edits as if they were new.
  void TickSet() override {
    started_ = w_.tick;
    for (Approach& a : approaches_) a.late = a.late || (a.ticks >= 0 && w_.tick > 0);
  }

  void Edited(const Edit& edit) override {
    const SeatEdit* taken = edit.As<SeatEdit>();
    if (taken != nullptr && taken->seat >= 0 &&
        static_cast<std::size_t>(taken->seat) < approaches_.size()) {
      const auto seat = static_cast<std::size_t>(taken->seat);
      approaches_[seat] = Approach();
      if (IsApart(seat)) approaches_[seat].ticks = 0;
      approaches_[seat].late =
          IsApart(seat) && started_ > 0 && w_.tick < started_ + w_.scene.solver.tick_hz;
    }
    if (taken != nullptr) FindSides();
    if (edit.As<BondEdit>() == nullptr) return;
    for (std::size_t s = 0; s < approaches_.size(); ++s) {
      if (approaches_[s].ticks < 0 || IsApart(s)) continue;
      RestoreMomentum(s);
      approaches_[s] = Approach();
    }
  }

  void BeforeTick() override {
    steps_ = 0;
    ghosts_.clear();
    for (std::size_t s = 0; s < approaches_.size(); ++s) {
      if (approaches_[s].ticks < 0) continue;
      if (!IsApart(s)) approaches_[s] = Approach();
      if (approaches_[s].late) Look(s);
      if (!Leads(s)) continue;
      if (approaches_[s].ticks == SeatWaitTicks(w_.scene.solver.tick_hz)) SetOut(s);
      ghosts_.resize(w_.built.moving.size(), false);
      EachOf(MechanismOf(s), [&](std::size_t body) { ghosts_[body] = true; });
    }
  }

  void BeforeStep(float h) override {
    ++steps_;
    for (std::size_t s = 0; s < approaches_.size(); ++s) {
      if (Leads(s)) Lead(s, h);
    }
  }

  void AfterTick() override {
    for (std::size_t s = 0; s < approaches_.size(); ++s) {
      Approach& a = approaches_[s];
      if (Leads(s) && !a.late) a.owed = a.came - MomentumOf(MechanismOf(s));
      if (a.ticks >= 0) ++a.ticks;
      if (a.ticks > kHeldSecondsMax * w_.scene.solver.tick_hz) a = Approach();
    }
  }

  void Save(std::vector<float>* memory) const override {
    for (const Approach& a : approaches_) {
      const Vec2 at = a.from.shift.cast<float>();
      memory->insert(memory->end(),
                     {static_cast<float>(a.late ? kLateFrom - a.ticks : a.ticks), at.x(), at.y(),
                      static_cast<float>(a.from.angle), a.came.x, a.came.y, a.owed.x, a.owed.y});
    }
  }
  void Load(StageMemory* memory) override {
    for (Approach& a : approaches_) {
      const int ticks = memory->NextInt(-kStageNumberMax, kStageNumberMax);
      a.late = ticks <= kLateFrom;
      a.ticks = a.late ? kLateFrom - ticks : ticks;
      const float x = memory->Next(), y = memory->Next();
      a.from = {Vec2(x, y).cast<double>(), static_cast<double>(memory->Next())};
      for (b2Vec2* momentum : {&a.came, &a.owed}) {
        momentum->x = memory->Next();
        momentum->y = memory->Next();
      }
    }
  }

  bool listens() const override { return true; }
  void PreSolve(b2Contact* contact) override {
    if (ghosts_.empty() && sides_.empty()) return;
    const int a = IndexOf(contact->GetFixtureA()->GetBody());
    const int b = IndexOf(contact->GetFixtureB()->GetBody());
    const bool passes = IsGhost(a) || IsGhost(b) || (SideOf(a) != 0 && SideOf(a) == -SideOf(b));
    if (passes) contact->SetEnabled(false);
  }

 private:
  const Seat& SeatOf(std::size_t seat) const { return w_.scene.seats[seat]; }
  PartId Sitter(std::size_t seat) const {
    const int player = SeatOf(seat).player;
    return player < 0 ? -1 : w_.scene.players[static_cast<std::size_t>(player)].vehicle;
  }
  /// Returns the index of an assembly; -1 if there is no such part.
  int AssemblyOf(PartId part) const {
    const auto p = static_cast<std::size_t>(part);
    return part < 0 ? -1 : w_.composition.assembly_of_part[p];
  }
  const Assembly& At(int assembly) const {
    return w_.composition.assemblies[static_cast<std::size_t>(assembly)];
  }

  bool IsGhost(int body) const {
    return body >= 0 && !ghosts_.empty() && ghosts_[static_cast<std::size_t>(body)];
  }
  int SideOf(int body) const {
    return body < 0 || sides_.empty() ? 0 : sides_[static_cast<std::size_t>(body)];
  }

  /// Returns true if the seat's part and the player's are one body.
  bool IsBonded(std::size_t seat) const {
    const int own = AssemblyOf(Sitter(seat));
    return own >= 0 && own == AssemblyOf(SeatOf(seat).part);
  }
  bool IsBondOf(std::size_t seat, const Joint& joint) const {
    return joint.kind == JointKind::kGlue && joint.a == SeatOf(seat).part &&
           joint.b == Sitter(seat);
  }
  /// Returns by part: true if joints other than the seat's bond connect it with the player.
  std::vector<bool> PartsOfSitter(std::size_t seat) const {
    std::vector<bool> found(w_.scene.parts.size(), false);
    found[static_cast<std::size_t>(Sitter(seat))] = true;
    for (bool more = true; more;) {
      more = false;
      for (const Joint& joint : w_.scene.joints) {
        if (joint.gone || IsBondOf(seat, joint)) continue;
        const auto a = static_cast<std::size_t>(joint.a), b = static_cast<std::size_t>(joint.b);
        const bool anchored = w_.scene.parts[a].anchored || w_.scene.parts[b].anchored;
        if (found[a] == found[b] || anchored) continue;
        found[a] = found[b] = more = true;
      }
    }
    return found;
  }
  /// Finds the bodies that are limbs of seated players, and those of the vehicles. The body formed
  /// by the bond counts as the vehicle's.
  void FindSides() {
    sides_.clear();
    for (std::size_t s = 0; s < approaches_.size(); ++s) {
      if (!IsBonded(s) || At(AssemblyOf(Sitter(s))).anchored) continue;
      const std::vector<bool> own = PartsOfSitter(s);
      if (own[static_cast<std::size_t>(SeatOf(s).part)]) continue;
      sides_.resize(w_.built.moving.size(), 0);
      const int whole = At(AssemblyOf(Sitter(s))).mechanism;
      const PartId root = At(AssemblyOf(Sitter(s))).id;
      EachOf(whole, [&](std::size_t body) {
        const int side = static_cast<int>(s) + 1;
        const PartId id = w_.built.moving[body].id;
        const bool limb = id != root && own[static_cast<std::size_t>(id)];
        sides_[body] = limb ? side : -side;
      });
    }
  }

  /// Returns true if a player has the seat, is of another mechanism, and can move.
  bool IsApart(std::size_t seat) const {
    const int own = AssemblyOf(Sitter(seat)), there = AssemblyOf(SeatOf(seat).part);
    if (own < 0 || there < 0 || At(own).anchored) return false;
    return At(there).anchored || At(own).mechanism != At(there).mechanism;
  }
  /// Requires IsApart.
  int MechanismOf(std::size_t seat) const { return At(AssemblyOf(Sitter(seat))).mechanism; }

  template <typename Visit>
  void EachOf(int mechanism, const Visit& visit) const {
    for (std::size_t i = 0; i < w_.built.moving.size(); ++i) {
      if (w_.built.moving[i].mechanism == mechanism) visit(i);
    }
  }
  b2Vec2 MomentumOf(int mechanism) const {
    b2Vec2 sum(0, 0);
    EachOf(mechanism, [&](std::size_t i) {
      const MovingBody& m = w_.built.moving[i];
      sum += m.mass.mass * m.body->GetLinearVelocity();
    });
    return sum;
  }

  /// Returns a part's pose, given that of its body.
  Transform2 PoseOfPart(PartId id, const Transform2& body) const {
    const Part& part = w_.scene.parts[static_cast<std::size_t>(id)];
    const Part& root = w_.scene.parts[static_cast<std::size_t>(At(AssemblyOf(id)).id)];
    return body.Then({ToRootFrame(part, root, Vector2d(0, 0)),
                      static_cast<double>(part.angle) - static_cast<double>(root.angle)});
  }
  b2Body& BodyOf(PartId part) const {
    return *w_.built.bodies[static_cast<std::size_t>(AssemblyOf(part))];
  }

  /// Returns true if the player is on the way, or waiting at its end, in this tick.
  bool Leads(std::size_t seat) const {
    return approaches_[seat].ticks >= SeatWaitTicks(w_.scene.solver.tick_hz) && IsApart(seat);
  }

  /// Returns the player's part's pose in the frame of the seat's part.
  Transform2 PlaceOf(std::size_t seat) const {
    const PartId own = Sitter(seat), there = SeatOf(seat).part;
    const Transform2 vehicle = PoseOfPart(there, PoseOf(BodyOf(there)));
    return vehicle.Inverse().Then(PoseOfPart(own, PoseOf(BodyOf(own))));
  }

  void SetOut(std::size_t seat) {
    approaches_[seat].from = Rounded(PlaceOf(seat));
    approaches_[seat].came = MomentumOf(MechanismOf(seat));
  }

  void Look(std::size_t seat) {
    const PartId own = Sitter(seat), there = SeatOf(seat).part;
    const Transform2 vehicle = PoseOfPart(there, PoseOf(BodyOf(there)));
    const Transform2 place = PlaceOf(seat);
    const b2Vec2 at = ToB2(vehicle(place.shift).cast<float>());
    const b2Vec2 speed = BodyOf(own).GetLinearVelocityFromWorldPoint(at) -
                         BodyOf(there).GetLinearVelocityFromWorldPoint(at);
    const Vector2d seen = vehicle.Inverse().Turned(FromB2(speed).cast<double>());
    EstimateWay(SeatOf(seat), w_.scene.solver, {place, seen}, &approaches_[seat]);
  }

  /// Sets all bodies' velocities so that, as one rigid body, they are in place after the step, as
  /// far as the pull allows. Bodies that are only displayed follow their own path.
  void Lead(std::size_t seat, float h) {
    const Approach& a = approaches_[seat];
    const PartId own = Sitter(seat);
    const b2Body& there = BodyOf(SeatOf(seat).part);
    Transform2 vehicle = PoseOf(there);
    const b2Vec2 speed = there.GetLinearVelocityFromLocalPoint(b2Vec2(0, 0));
    vehicle.shift += static_cast<double>(h) * FromB2(speed).cast<double>();
    vehicle.angle += static_cast<double>(h * there.GetAngularVelocity());
    const double ticks = a.ticks + static_cast<double>(steps_) / w_.scene.solver.substeps;
    const double share = ShareOfWay(ticks, w_.scene.solver.tick_hz);
    const Vec2& at = SeatOf(seat).at;
    const double turn = WrapAngle(static_cast<double>(SeatOf(seat).angle) - a.from.angle);
    const Transform2 way{(1 - share) * a.from.shift + share * at.cast<double>(),
                         a.from.angle + share * turn};
    const Transform2 wanted = PoseOfPart(SeatOf(seat).part, vehicle).Then(way);
    Transform2 now = PoseOfPart(own, PoseOf(BodyOf(own)));
    now.angle = UnwrapAngle(now.angle, wanted.angle);
    const Transform2 moves = wanted.Then(now.Inverse());
    // A player that has fallen behind catches up at no more than twice the highest speed of the
    // way.
    const double fastest = 3 * (a.from.shift - at.cast<double>()).norm() / kSeatSeconds + 0.5;
    const auto velocity_of = [&](const b2Body* body) {
      const Vector2d centre = FromB2(body->GetWorldCenter()).cast<double>();
      const Vector2d with = FromB2(speed).cast<double>();
      Vector2d beyond = (moves(centre) - centre) / static_cast<double>(h) - with;
      if (beyond.norm() > fastest) beyond *= fastest / beyond.norm();
      return ToB2((with + beyond).cast<float>());
    };
    const auto each = [&](const auto& visit) {
      EachOf(MechanismOf(seat), [&](std::size_t i) {
        const MovingBody& moving = w_.built.moving[i];
        if (w_.activities[i] == Activity::kSimulated) visit(moving.body, moving.mass.mass);
      });
    };
    PullTogether(each, velocity_of, static_cast<float>(moves.angle) / h, h, gravity_);
  }

  /// Distributes the momentum over the whole joined mechanism in proportion to mass, which does not
  /// strain its joints.
  void RestoreMomentum(std::size_t seat) {
    const int whole = AssemblyOf(SeatOf(seat).part);
    if (whole < 0 || At(whole).anchored) return;
    float mass = 0;
    EachOf(At(whole).mechanism, [&](std::size_t i) { mass += w_.built.moving[i].mass.mass; });
    EachOf(At(whole).mechanism, [&](std::size_t i) {
      if (w_.activities[i] != Activity::kSimulated) return;
      b2Body* body = w_.built.moving[i].body;
      body->SetLinearVelocity(body->GetLinearVelocity() + (1 / mass) * approaches_[seat].owed);
    });
  }

  const StageWorld w_;
  std::vector<Approach> approaches_;  // by the scene's seats
  std::int64_t started_ = 0;          // tick at which this peer joined
  std::vector<bool> ghosts_;          // by moving body; empty: no approach
  std::vector<int> sides_;  // by moving body: seat number from 1, -: the vehicle; empty: none
  b2Vec2 gravity_{0, 0};
  int steps_ = 0;  // of the engine, in this tick
};

}  // namespace

std::unique_ptr<Stage> MakeSeatStage(const StageWorld& world) {
  return std::make_unique<SeatStage>(world);
}

}  // namespace seam
